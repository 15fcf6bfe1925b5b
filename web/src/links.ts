// Runs inside a page of results that links to others, such as a session's: a frame cannot open them, so it tells the page around it.

document.addEventListener("click", (event) => {
  const link = event.target instanceof Element ? event.target.closest("a[href]") : null;
  const address = link?.getAttribute("href") ?? "";
  if (address.endsWith(".html")) {
    event.preventDefault();
    parent.postMessage({ open: decodeURIComponent(address) }, "*");
  }
});
