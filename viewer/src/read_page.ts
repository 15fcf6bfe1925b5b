import { FORMAT, type Page } from "./contract";
import { Numbers } from "./numbers";

/** The data of a page. */
export interface PageData {
  readonly page: Page;
  readonly numbers: Numbers;
}

/** Reads the data from the page's own elements; error messages are written for the reader of the page. */
export async function readPage(): Promise<PageData> {
  const page = pageOf(textOf("ambulo-page"));
  if (typeof DecompressionStream === "undefined") {
    throw new Error(
      "This browser is too old: it cannot unpack the numbers of the report. Use Chrome or Edge 80, Safari 16.4, Firefox 113, or later.",
    );
  }
  return { page, numbers: await numbersOf(textOf("ambulo-numbers")) };
}

/** Parses the page's description; throws if this viewer cannot read its format. */
export function pageOf(text: string): Page {
  let page: Page;
  try {
    page = JSON.parse(text) as Page;
  } catch {
    throw new Error(
      "The data of this report cannot be read: the file seems to be incomplete or changed. Make the report again with `ambulo report`.",
    );
  }
  if (page.format !== FORMAT) {
    throw new Error(
      `The data of this report have format ${page.format}, but this viewer expects ${FORMAT}. Make the report again with \`ambulo report\`.`,
    );
  }
  return page;
}

async function numbersOf(text: string): Promise<Numbers> {
  try {
    return await Numbers.decode(text);
  } catch {
    throw new Error(
      "The numbers of this report cannot be unpacked: the file seems to be incomplete or changed. Make the report again with `ambulo report`.",
    );
  }
}

function textOf(id: string): string {
  const text = document.getElementById(id)?.textContent ?? "";
  if (text.trim() === "") {
    throw new Error("This file contains no report: its data are missing. Make the report again with `ambulo report`.");
  }
  return text;
}
