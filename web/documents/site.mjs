// The documents alone, without the page that computes: `node web/documents/site.mjs FOLDER`; AMBULO names the program
// that draws the gallery.
import { mkdirSync, rmSync } from "node:fs";
import { writeDocuments } from "./documents.mjs";
import { drawGallery } from "./gallery.mjs";

const [folder] = process.argv.slice(2);
if (!folder) {
  throw new Error("usage: node web/documents/site.mjs FOLDER");
}
rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
const gallery = process.env.AMBULO ? await drawGallery(process.env.AMBULO, folder) : undefined;
process.stdout.write(`${folder}: ${writeDocuments(folder, { api: false, gallery })} files\n`);
