"""A batch as tasks of Ray: python ray_batch.py SOURCE RESULTS [SHARDS] [ADDRESS].

Each task starts the command `ambulo` for one shard. Ray repeats a task whose worker is lost, and the command continues at the first part that is
not closed. Without the address of a cluster (`auto` for the one that this machine belongs to), Ray is started on this machine.
"""

import subprocess
import sys
import time

import ray


@ray.remote(num_cpus=1, max_retries=10)
def shard(source: str, results: str, index: int, count: int) -> str:
    """Compute one shard; return what the command printed."""
    words = ["ambulo", "batch", source, "-o", results, "--resume", "--jobs", "1", "--shard", f"{index}/{count}"]
    while True:
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        # The command of a lost worker may live on for a while; it closes its parts, and this one continues behind it.
        if "another batch is writing" not in done.stderr:
            break
        time.sleep(1)
    # A share of the trials may have none that can be computed: the table of trials says why.
    if done.returncode != 0 and "trials could be computed" not in done.stderr:
        raise RuntimeError(done.stderr)
    return done.stdout + done.stderr


def main() -> None:
    """Compute all shards."""
    source, results = sys.argv[1:3]
    count = int(sys.argv[3]) if len(sys.argv) > 3 else 8
    ray.init(address=sys.argv[4] if len(sys.argv) > 4 else "local", include_dashboard=False, log_to_driver=False)
    for text in ray.get([shard.remote(source, results, index, count) for index in range(count)]):
        print(text, end="")


if __name__ == "__main__":
    main()
