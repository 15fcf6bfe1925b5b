"""Replays joint angles of a `.mot` file over the Lab Streaming Layer at their rate, to try `lsl_forces.py`.

Needs `pip install pylsl`. After `ambulo demo -o demo`:

    python examples/lsl_replay.py demo/input/walk.mot
"""

import argparse
import time

import pylsl


def read(path):
    """Names of the columns and rows of a storage file in degrees."""
    with open(path, encoding="utf-8") as file:
        lines = iter(file.read().splitlines())
    for line in lines:
        if line.strip() == "endheader":
            break
    names = next(lines).split()
    return names, [[float(cell) for cell in line.split()] for line in lines if line.strip()]


def main():
    parser = argparse.ArgumentParser(description="Replays joint angles over the Lab Streaming Layer.")
    parser.add_argument("file", help="joint angles (.mot) in degrees")
    parser.add_argument("--name", default="Motion", help="name of the stream")
    options = parser.parse_args()

    names, rows = read(options.file)
    rate = round((len(rows) - 1) / (rows[-1][0] - rows[0][0]), 6)
    info = pylsl.StreamInfo(options.name, "MoCap", len(names) - 1, rate, pylsl.cf_double64, f"ambulo-replay-{options.name}")
    channels = info.desc().append_child("channels")
    for name in names[1:]:
        channels.append_child("channel").append_child_value("label", name)
    outlet = pylsl.StreamOutlet(info)
    print("waiting for a receiver", flush=True)
    outlet.wait_for_consumers(60)
    start = pylsl.local_clock()
    for row in rows:
        due = start + row[0] - rows[0][0]
        time.sleep(max(due - pylsl.local_clock(), 0.0))
        outlet.push_sample(row[1:], due)
    # The last samples are sent before the stream ends.
    time.sleep(1.0)


if __name__ == "__main__":
    main()
