"""Compress wheels again: `python packaging/smallest_wheel.py WHEEL...`. Needs the package zopfli.

A wheel is a ZIP archive. Its files stay the same, so its RECORD with their hashes does too; only the search for the shortest deflate stream is longer than
zlib's. Any program that reads ZIP reads the result. The same wheel always gives the same bytes.

Source: PKWARE, APPNOTE.TXT - .ZIP File Format Specification, 4.3.7, 4.3.12, 4.3.16 (unverified).
"""

from __future__ import annotations

import struct
import sys
import zipfile
from pathlib import Path

import zopfli.zlib

DEFLATED = 8
MADE_BY_UNIX = 3 << 8 | 20
NEEDS_VERSION = 20
UTF8_NAMES = 0x800
# 1980-01-01, the first day that ZIP knows: the same files give the same archive.
TIME, DATE = 0, 0x21
# Rounds of the search; 15 is zopfli's own default.
ROUNDS = 15


def deflated(content: bytes) -> bytes:
    """Return the raw deflate stream: that of zlib has two bytes before it and a checksum of four after it."""
    return zopfli.zlib.compress(content, numiterations=ROUNDS)[2:-4]


def smallest(archive: zipfile.ZipFile) -> bytes:
    """Return the archive again with the shortest streams that zopfli finds."""
    out, directory = bytearray(), bytearray()
    entries = [entry for entry in archive.infolist() if not entry.is_dir()]
    for entry in entries:
        content = archive.read(entry)
        stream, name = deflated(content), entry.filename.encode()
        fields = (UTF8_NAMES, DEFLATED, TIME, DATE, entry.CRC, len(stream), len(content), len(name))
        directory += struct.pack("<4sHHHHHHIIIH", b"PK\1\2", MADE_BY_UNIX, NEEDS_VERSION, *fields)
        directory += struct.pack("<HHHHII", 0, 0, 0, 0, entry.external_attr, len(out)) + name
        out += struct.pack("<4sHHHHHIIIHH", b"PK\3\4", NEEDS_VERSION, *fields, 0) + name + stream
    end = struct.pack("<4sHHHHIIH", b"PK\5\6", 0, 0, len(entries), len(entries), len(directory), len(out), 0)
    return bytes(out + directory + end)


def replace(path: Path) -> None:
    """Replace a wheel by a smaller one with the same files."""
    wheel = path.read_bytes()
    with zipfile.ZipFile(path) as archive:
        contents = {entry.filename: archive.read(entry) for entry in archive.infolist() if not entry.is_dir()}
        smaller = smallest(archive)
    new = path.with_suffix(".new")
    new.write_bytes(smaller)
    with zipfile.ZipFile(new) as archive:
        if {name: archive.read(name) for name in archive.namelist()} != contents:
            sys.exit(f"{path}: the new archive has other contents than the wheel; the wheel is unchanged")
    new.replace(path)
    print(f"{path}: {len(wheel) / 1e6:.2f} MB, now {len(smaller) / 1e6:.2f} MB")


if __name__ == "__main__":
    if not sys.argv[1:]:
        sys.exit("usage: python packaging/smallest_wheel.py WHEEL...")
    for name in sys.argv[1:]:
        replace(Path(name))
