"""Forces of a motion that arrives over the Lab Streaming Layer, on a stream of their own.

Needs the command `ambulo` and `pip install pylsl`. The stream with the motion has one channel per coordinate of the model, labelled with
its name, in degrees and metres, and a regular rate:

    python examples/lsl_forces.py demo/input/figure.osim --input Motion --output Forces

The stream of forces has the channels of `ambulo stream --describe`. docs/STREAMING.md has the delay and the accuracy.
"""

import argparse
import json
import subprocess
import threading

import pylsl


def labels(info):
    """Names of the channels of a stream."""
    channel = info.desc().child("channels").child("channel")
    names = []
    for _ in range(info.channel_count()):
        names.append(channel.child_value("label"))
        channel = channel.next_sibling()
    return names


def outlet_of(description, name):
    """A stream for the results that the command describes."""
    columns, rate = description["columns"], description["rate_hz"]
    info = pylsl.StreamInfo(name, "Forces", len(columns), rate, pylsl.cf_float32, f"ambulo-{description['model']}")
    channels = info.desc().append_child("channels")
    for column, unit in zip(columns, description["units"]):
        channels.append_child("channel").append_child_value("label", column).append_child_value("unit", unit)
    return pylsl.StreamOutlet(info)


def publish(lines, name, first_time):
    """Sends each result with the time of its frame; prints notices."""
    description = json.loads(next(lines))
    outlet = outlet_of(description, name)
    for line in lines:
        answer = json.loads(line)
        if "values" in answer:
            outlet.push_sample(answer["values"], first_time[0] + answer["time"])
        else:
            print(f"{answer['notice']}: {answer['message']}", flush=True)


def main():
    parser = argparse.ArgumentParser(description="Forces of a motion that arrives over the Lab Streaming Layer.")
    parser.add_argument("model", help="OpenSim model (.osim) of the coordinates")
    parser.add_argument("--input", default="Motion", help="name of the stream with the motion")
    parser.add_argument("--output", default="Forces", help="name of the stream of forces")
    parser.add_argument("--delay", default="70", help="time from a frame to its forces [ms]")
    parser.add_argument("--ambulo", default="ambulo", help="the command")
    options = parser.parse_args()

    found = pylsl.resolve_byprop("name", options.input, timeout=60)
    if not found:
        raise SystemExit(f"no stream is named {options.input}; expected one within 60 s. hint: start the motion first")
    inlet = pylsl.StreamInlet(found[0])
    info = inlet.info()
    rate = info.nominal_srate()
    words = [options.ambulo, "stream", options.model, "--rate", str(rate), "--delay", options.delay]
    command = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1)
    first_time = []
    publisher = threading.Thread(target=publish, args=(command.stdout, options.output, first_time))
    publisher.start()
    command.stdin.write(json.dumps({"coordinates": labels(info), "angles": "deg"}) + "\n")
    try:
        while True:
            sample, time = inlet.pull_sample(timeout=5)
            if sample is None:
                break
            if not first_time:
                first_time.append(time)
            # From its time the command sees lost frames.
            command.stdin.write(json.dumps({"time": max(time - first_time[0], 0.0), "q": sample}) + "\n")
    except KeyboardInterrupt:
        pass
    command.stdin.close()
    publisher.join()


if __name__ == "__main__":
    main()
