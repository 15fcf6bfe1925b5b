import { FORMAT, type Page } from "./contract";
import { Numbers } from "./numbers";

/** Data of a page. */
export interface PageData {
  readonly page: Page;
  readonly numbers: Numbers;
}

/** Data out of the page's own elements; the error's message is for the reader. */
export async function readPage(): Promise<PageData> {
  const page = pageOf(textOf("ambulo-page"));
  if (typeof DecompressionStream === "undefined") {
    throw new Error(
      "This browser is too old for the report: it cannot unpack the page's numbers. Please use Chrome or Edge 80, Safari 16.4, Firefox 113, or a later one.",
    );
  }
  return { page, numbers: await numbersOf(textOf("ambulo-numbers")) };
}

/** The page's description, if it is one that this viewer understands. */
export function pageOf(text: string): Page {
  let page: Page;
  try {
    page = JSON.parse(text) as Page;
  } catch {
    throw new Error("The data of this report cannot be read: the file seems to be cut off or changed.");
  }
  if (page.format !== FORMAT) {
    throw new Error(`The data of this report have format ${page.format}, its viewer needs ${FORMAT}.`);
  }
  return page;
}

async function numbersOf(text: string): Promise<Numbers> {
  try {
    return await Numbers.decode(text);
  } catch {
    throw new Error("The numbers of this report cannot be unpacked: the file seems to be cut off or changed.");
  }
}

function textOf(id: string): string {
  const text = document.getElementById(id)?.textContent ?? "";
  if (text.trim() === "") {
    throw new Error("This file holds no report: its data are missing.");
  }
  return text;
}
