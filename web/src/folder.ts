// Reads what is dropped on the page: files, and folders with all files in them.

import { isRead } from "./files";

/** What was dropped. */
export interface DroppedFiles {
  files: File[];
  /** Name of the folder, if a single one was dropped. */
  folder: string | undefined;
}

/** The files of a drop. Call it before the event ends: the browser forgets the drop then. */
export async function droppedFiles(drop: DataTransfer | null): Promise<DroppedFiles> {
  const entries = [...(drop?.items ?? [])].map((item) => item.webkitGetAsEntry()).filter((entry) => entry !== null);
  const folders = entries.filter((entry) => entry.isDirectory);
  if (folders.length === 0) {
    return { files: [...(drop?.files ?? [])], folder: undefined };
  }
  const inside = await Promise.all(folders.map((folder) => filesIn(folder as FileSystemDirectoryEntry)));
  const beside = await Promise.all(entries.filter((entry) => entry.isFile).map((entry) => fileOf(entry)));
  const files = [...beside, ...inside.flat()];
  if (files.length === 0) {
    throw new Error(`${folders[0]?.name}: found no recording in this folder; expected C3D, TRC, BVH or others.`);
  }
  return { files, folder: folders.length === 1 ? folders[0]?.name : undefined };
}

function fileOf(entry: FileSystemEntry): Promise<File> {
  return new Promise((resolve, reject) => (entry as FileSystemFileEntry).file(resolve, reject));
}

/** All files in a folder that the command reads, and in the folders in it. */
async function filesIn(folder: FileSystemDirectoryEntry): Promise<File[]> {
  const reader = folder.createReader();
  const found: FileSystemEntry[] = [];
  // A reader returns a part of the entries at a time, and none at the end.
  for (;;) {
    const some = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
    if (some.length === 0) {
      break;
    }
    found.push(...some);
  }
  const wanted = found.filter((entry) => entry.isDirectory || isRead(entry.name));
  const inside = wanted.map((entry) =>
    entry.isDirectory ? filesIn(entry as FileSystemDirectoryEntry) : fileOf(entry).then((file) => [file]),
  );
  return (await Promise.all(inside)).flat();
}
