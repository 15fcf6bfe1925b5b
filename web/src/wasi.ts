// Runs the command, a WebAssembly module for WASI preview 1, with files in memory. The functions and layouts are those of
// https://github.com/WebAssembly/WASI/blob/main/legacy/preview1/docs.md; only what the command imports is here.

/** Content of files by path, such as `out/summary.json`. */
export type Files = Map<string, Uint8Array>;

/** Result of a command. */
export interface Ended {
  /** Exit code: 0 passed, 1 a check failed, 2 an error. */
  code: number;
  /** Text of standard output. */
  printed: string;
  /** Text of standard error. */
  complained: string;
  /** All files, also those that were given. */
  files: Files;
}

/** Numbers of errors. */
const Errno = { ok: 0, badf: 8, exist: 20, inval: 28, isdir: 31, noent: 44, notdir: 54, notempty: 55, notsup: 58 };
const FileType = { folder: 3, file: 4, stream: 6 };
const OpenFlag = { create: 1, folder: 2, exclusive: 4, truncate: 8 };
const APPEND = 1;
/** The only folder that is open from the beginning. */
const ROOT = 3;
const ALL_RIGHTS = 0xffff_ffff_ffff_ffffn;
const NANOSECONDS = 1e6;

/** A file; its bytes may have room after its end. */
class Content {
  bytes: Uint8Array;
  length: number;

  constructor(bytes: Uint8Array) {
    this.bytes = bytes;
    this.length = bytes.length;
  }

  resize(length: number): void {
    if (length > this.bytes.length) {
      // Doubling: a file is written in many small pieces.
      const larger = new Uint8Array(Math.max(length, 2 * this.bytes.length));
      larger.set(this.bytes.subarray(0, this.length));
      this.bytes = larger;
    }
    this.bytes.fill(0, Math.min(this.length, length), length);
    this.length = length;
  }

  write(piece: Uint8Array, at: number): void {
    if (at + piece.length > this.length) {
      this.resize(at + piece.length);
    }
    this.bytes.set(piece, at);
  }

  whole(): Uint8Array {
    return this.bytes.subarray(0, this.length);
  }
}

class Folder {
  readonly entries = new Map<string, Entry>();
}

type Entry = Content | Folder;

/** Standard output or standard error. */
class Stream {
  private readonly decoder = new TextDecoder();
  text = "";

  write(piece: Uint8Array): void {
    this.text += this.decoder.decode(piece, { stream: true });
  }
}

interface Open {
  entry: Entry | Stream;
  position: number;
  append: boolean;
}

/** Ends the command. */
class Exit {
  constructor(readonly code: number) {}
}

/** An error that the command is told. */
class Refused {
  constructor(readonly errno: number) {}
}

function refuse(errno: number): never {
  throw new Refused(errno);
}

/** The parts of a path; `..` does not leave the root. */
function parts(path: string): string[] {
  const out: string[] = [];
  for (const part of path.split("/")) {
    if (part === "..") {
      out.pop();
    } else if (part !== "" && part !== ".") {
      out.push(part);
    }
  }
  return out;
}

/** The entry below a folder, if there is one. */
function find(folder: Folder, path: string[]): Entry | undefined {
  let at: Entry | undefined = folder;
  for (const part of path) {
    if (at instanceof Content) {
      refuse(Errno.notdir);
    }
    at = at?.entries.get(part);
  }
  return at;
}

function place(folder: Folder, path: string): { parent: Folder; name: string } {
  const all = parts(path);
  const name = all.pop() ?? refuse(Errno.inval);
  const parent = find(folder, all) ?? refuse(Errno.noent);
  return parent instanceof Folder ? { parent, name } : refuse(Errno.notdir);
}

/** A command while it runs. */
class Command {
  readonly root = new Folder();
  readonly printed = new Stream();
  readonly complained = new Stream();
  private readonly opened = new Map<number, Open>();
  private readonly inodes = new Map<object, bigint>();
  private readonly words: Uint8Array[];
  private next = ROOT + 1;
  private memory = new WebAssembly.Memory({ initial: 0 });

  constructor(words: string[], files: Files) {
    this.words = words.map((word) => new TextEncoder().encode(`${word}\0`));
    for (const [path, bytes] of files) {
      this.put(path, bytes);
    }
    const streams = [new Stream(), this.printed, this.complained];
    streams.forEach((entry, fd) => {
      this.opened.set(fd, { entry, position: 0, append: false });
    });
    this.opened.set(ROOT, { entry: this.root, position: 0, append: false });
  }

  /** Runs the module; returns the exit code. */
  async run(module: WebAssembly.Module): Promise<number> {
    const offered = this.functions();
    for (const { name } of WebAssembly.Module.imports(module)) {
      // A function that is missing here fails when it is called. Without an entry the program would not start.
      offered[name] ??= () => Errno.notsup;
    }
    const instance = await WebAssembly.instantiate(module, { wasi_snapshot_preview1: offered });
    this.memory = instance.exports["memory"] as WebAssembly.Memory;
    try {
      (instance.exports["_start"] as () => void)();
      return 0;
    } catch (thrown) {
      if (thrown instanceof Exit) {
        return thrown.code;
      }
      throw thrown;
    }
  }

  /** All files by path. */
  files(folder = this.root, path = ""): Files {
    const out: Files = new Map();
    for (const [name, entry] of folder.entries) {
      if (entry instanceof Content) {
        out.set(path + name, entry.whole());
      } else {
        for (const [inner, bytes] of this.files(entry, `${path}${name}/`)) {
          out.set(inner, bytes);
        }
      }
    }
    return out;
  }

  private put(path: string, bytes: Uint8Array): void {
    const all = parts(path);
    const name = all.pop() ?? "";
    let folder = this.root;
    for (const part of all) {
      const inner = folder.entries.get(part) ?? new Folder();
      folder.entries.set(part, inner);
      folder = inner as Folder;
    }
    folder.entries.set(name, new Content(bytes));
  }

  /** The imported functions; each returns the number of an error. */
  private functions(): WebAssembly.ModuleImports {
    const own = [this.process(), this.descriptors(), this.folders(), this.paths()];
    const guarded = Object.entries(Object.assign({}, ...own) as Record<string, Imported>).map(([name, call]) => {
      const safe = (...values: never[]): number => {
        try {
          call(...values);
          return Errno.ok;
        } catch (thrown) {
          if (thrown instanceof Refused) {
            return thrown.errno;
          }
          throw thrown;
        }
      };
      return [name, safe];
    });
    return Object.fromEntries(guarded) as WebAssembly.ModuleImports;
  }

  private process(): Record<string, Imported> {
    return {
      args_sizes_get: (count: number, size: number) => {
        this.view().setUint32(count, this.words.length, true);
        this.view().setUint32(
          size,
          this.words.map((word) => word.length).reduce((a, b) => a + b, 0),
          true,
        );
      },
      args_get: (pointers: number, text: number) => {
        let at = text;
        this.words.forEach((word, index) => {
          this.view().setUint32(pointers + 4 * index, at, true);
          this.bytes(at, word.length).set(word);
          at += word.length;
        });
      },
      environ_sizes_get: (count: number, size: number) => {
        this.view().setUint32(count, 0, true);
        this.view().setUint32(size, 0, true);
      },
      environ_get: () => {},
      clock_time_get: (_clock: number, _precision: bigint, out: number) => {
        const now = performance.timeOrigin + performance.now();
        this.view().setBigUint64(out, BigInt(Math.round(now * NANOSECONDS)), true);
      },
      random_get: (out: number, count: number) => {
        crypto.getRandomValues(this.bytes(out, count) as Uint8Array<ArrayBuffer>);
      },
      proc_exit: (code: number) => {
        throw new Exit(code);
      },
    };
  }

  /** Functions of open files. */
  private descriptors(): Record<string, Imported> {
    const moved = (open: Open, pieces: Uint8Array[], move: (piece: Uint8Array) => number): number => {
      let total = 0;
      for (const piece of pieces) {
        const count = move(piece);
        total += count;
        open.position += count;
        if (count < piece.length) {
          break;
        }
      }
      return total;
    };
    return {
      fd_read: (fd: number, pieces: number, count: number, out: number) => {
        const open = this.open(fd);
        const total = moved(open, this.pieces(pieces, count), (piece) => this.read(open, piece));
        this.view().setUint32(out, total, true);
      },
      fd_write: (fd: number, pieces: number, count: number, out: number) => {
        const open = this.open(fd);
        const total = moved(open, this.pieces(pieces, count), (piece) => this.write(open, piece));
        this.view().setUint32(out, total, true);
      },
      fd_seek: (fd: number, offset: bigint, from: number, out: number) => {
        const open = this.open(fd);
        const { length } = open.entry instanceof Content ? open.entry : refuse(Errno.inval);
        const to = ([0, open.position, length][from] ?? refuse(Errno.inval)) + Number(offset);
        open.position = to < 0 ? refuse(Errno.inval) : to;
        this.view().setBigUint64(out, BigInt(to), true);
      },
      fd_close: (fd: number) => {
        this.open(fd);
        this.opened.delete(fd);
      },
      fd_sync: (fd: number) => {
        this.open(fd);
      },
      fd_fdstat_get: (fd: number, out: number) => {
        const { entry, append } = this.open(fd);
        this.bytes(out, 24).fill(0);
        this.view().setUint8(out, fileType(entry));
        this.view().setUint16(out + 2, append ? APPEND : 0, true);
        this.view().setBigUint64(out + 8, ALL_RIGHTS, true);
        this.view().setBigUint64(out + 16, ALL_RIGHTS, true);
      },
      fd_filestat_get: (fd: number, out: number) => this.writeStat(this.open(fd).entry, out),
    };
  }

  /** Functions of open folders. */
  private folders(): Record<string, Imported> {
    return {
      fd_prestat_get: (fd: number, out: number) => {
        this.view().setUint32(out, fd === ROOT ? 0 : refuse(Errno.badf), true);
        this.view().setUint32(out + 4, 1, true);
      },
      fd_prestat_dir_name: (fd: number, out: number) => {
        this.view().setUint8(out, fd === ROOT ? "/".charCodeAt(0) : refuse(Errno.badf));
      },
      fd_readdir: (fd: number, out: number, size: number, cookie: bigint, used: number) => {
        const { entry } = this.open(fd);
        const folder = entry instanceof Folder ? entry : refuse(Errno.notdir);
        let at = 0;
        [...folder.entries].slice(Number(cookie)).forEach(([name, inner], index) => {
          const record = this.directoryEntry(name, inner, cookie + BigInt(index) + 1n);
          const fits = record.subarray(0, Math.max(size - at, 0));
          this.bytes(out + at, fits.length).set(fits);
          at += fits.length;
        });
        this.view().setUint32(used, at, true);
      },
    };
  }

  /** Functions of paths below an open folder. */
  private paths(): Record<string, Imported> {
    return {
      path_open: (
        fd: number,
        _follow: number,
        path: number,
        length: number,
        how: number,
        _rights: bigint,
        _inherited: bigint,
        flags: number,
        out: number,
      ) => {
        const entry = this.openPath(this.folder(fd), this.text(path, length), how);
        const number = this.next++;
        this.opened.set(number, { entry, position: 0, append: (flags & APPEND) !== 0 });
        this.view().setUint32(out, number, true);
      },
      path_filestat_get: (fd: number, _follow: number, path: number, length: number, out: number) => {
        this.writeStat(find(this.folder(fd), parts(this.text(path, length))) ?? refuse(Errno.noent), out);
      },
      path_create_directory: (fd: number, path: number, length: number) => {
        const { parent, name } = place(this.folder(fd), this.text(path, length));
        parent.entries.set(name, parent.entries.has(name) ? refuse(Errno.exist) : new Folder());
      },
      path_unlink_file: (fd: number, path: number, length: number) => {
        const { parent, name } = place(this.folder(fd), this.text(path, length));
        const entry = parent.entries.get(name) ?? refuse(Errno.noent);
        parent.entries.delete(entry instanceof Folder ? refuse(Errno.isdir) : name);
      },
      path_remove_directory: (fd: number, path: number, length: number) => {
        const { parent, name } = place(this.folder(fd), this.text(path, length));
        const entry = parent.entries.get(name) ?? refuse(Errno.noent);
        const inside = entry instanceof Folder ? entry.entries.size : refuse(Errno.notdir);
        parent.entries.delete(inside > 0 ? refuse(Errno.notempty) : name);
      },
      path_rename: (fd: number, from: number, length: number, toFd: number, to: number, toLength: number) => {
        const old = place(this.folder(fd), this.text(from, length));
        const entry = old.parent.entries.get(old.name) ?? refuse(Errno.noent);
        const target = place(this.folder(toFd), this.text(to, toLength));
        if (target.parent.entries.get(target.name) instanceof Folder) {
          refuse(Errno.isdir);
        }
        old.parent.entries.delete(old.name);
        target.parent.entries.set(target.name, entry);
      },
      // There are no links.
      path_readlink: () => refuse(Errno.inval),
    };
  }

  private openPath(folder: Folder, path: string, how: number): Entry {
    const found = find(folder, parts(path));
    if (!found) {
      const { parent, name } = place(folder, path);
      const created = (how & OpenFlag.create) === 0 ? refuse(Errno.noent) : new Content(new Uint8Array());
      parent.entries.set(name, created);
      return created;
    }
    if ((how & OpenFlag.exclusive) !== 0) {
      refuse(Errno.exist);
    }
    if (found instanceof Folder) {
      return (how & (OpenFlag.create | OpenFlag.truncate)) === 0 ? found : refuse(Errno.isdir);
    }
    if ((how & OpenFlag.folder) !== 0) {
      refuse(Errno.notdir);
    }
    if ((how & OpenFlag.truncate) !== 0) {
      // A file that was given keeps its bytes.
      [found.bytes, found.length] = [new Uint8Array(), 0];
    }
    return found;
  }

  private read(open: Open, piece: Uint8Array): number {
    if (open.entry instanceof Folder) {
      refuse(Errno.isdir);
    }
    if (open.entry instanceof Stream) {
      return 0;
    }
    const bytes = open.entry.whole().subarray(open.position, open.position + piece.length);
    piece.set(bytes);
    return bytes.length;
  }

  private write(open: Open, piece: Uint8Array): number {
    const { entry } = open;
    if (entry instanceof Folder) {
      refuse(Errno.isdir);
    }
    if (entry instanceof Stream) {
      entry.write(piece);
      return piece.length;
    }
    if (open.append) {
      open.position = entry.length;
    }
    entry.write(piece, open.position);
    return piece.length;
  }

  private writeStat(entry: Entry | Stream, out: number): void {
    this.bytes(out, 64).fill(0);
    this.view().setBigUint64(out + 8, this.inode(entry), true);
    this.view().setUint8(out + 16, fileType(entry));
    this.view().setBigUint64(out + 24, 1n, true);
    this.view().setBigUint64(out + 32, BigInt(entry instanceof Content ? entry.length : 0), true);
  }

  private directoryEntry(name: string, entry: Entry, next: bigint): Uint8Array {
    const text = new TextEncoder().encode(name);
    const record = new Uint8Array(24 + text.length);
    const view = new DataView(record.buffer);
    view.setBigUint64(0, next, true);
    view.setBigUint64(8, this.inode(entry), true);
    view.setUint32(16, text.length, true);
    view.setUint8(20, fileType(entry));
    record.set(text, 24);
    return record;
  }

  private inode(entry: object): bigint {
    const known = this.inodes.get(entry) ?? BigInt(this.inodes.size + 1);
    this.inodes.set(entry, known);
    return known;
  }

  private open(fd: number): Open {
    return this.opened.get(fd) ?? refuse(Errno.badf);
  }

  private folder(fd: number): Folder {
    const { entry } = this.open(fd);
    return entry instanceof Folder ? entry : refuse(Errno.notdir);
  }

  // The memory may have grown and moved since the last call.
  private view(): DataView {
    return new DataView(this.memory.buffer);
  }

  private bytes(at: number, count: number): Uint8Array {
    return new Uint8Array(this.memory.buffer, at, count);
  }

  private text(at: number, count: number): string {
    return new TextDecoder().decode(this.bytes(at, count));
  }

  private pieces(at: number, count: number): Uint8Array[] {
    const view = this.view();
    return Array.from({ length: count }, (_, index) => {
      const piece = at + 8 * index;
      return this.bytes(view.getUint32(piece, true), view.getUint32(piece + 4, true));
    });
  }
}

// biome-ignore lint/suspicious/noExplicitAny: the module calls with the types of its own signature
type Imported = (...values: any[]) => void;

function fileType(entry: Entry | Stream): number {
  if (entry instanceof Folder) {
    return FileType.folder;
  }
  return entry instanceof Content ? FileType.file : FileType.stream;
}

/** Runs the command with these words, of which the first is the name of the program. */
export async function run(module: WebAssembly.Module, words: string[], files: Files): Promise<Ended> {
  const command = new Command(words, files);
  const code = await command.run(module);
  return { code, printed: command.printed.text, complained: command.complained.text, files: command.files() };
}
