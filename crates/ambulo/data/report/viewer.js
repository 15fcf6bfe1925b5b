document.getElementById("ambulo").textContent="viewer not built";
