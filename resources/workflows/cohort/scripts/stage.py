"""Runs one command of one case, and keeps what it said in LOG.log and how it ended in LOG.exit; until then that file
tells that it was started, and stays like this if it is killed together with its command:

    python3 stage.py [--display] [--to FILE] LOG.log COMMAND ARGUMENT...

--display: the command draws, and gets a display of its own where Xvfb is; one that the environment names may be that
of another machine. --to FILE: what it prints becomes FILE, once it has ended well. A check that does not hold (exit
code 7) leaves its results and is no failure here; the page tells it."""

import contextlib
import json
import os
import platform
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

CHECK_FAILED = 7


def give_key(file):
    """Writes the key of a display, so that nobody else on this machine may look at it (X's form of it: for any
    machine, with any number)."""
    parts = (b"", b"", b"MIT-MAGIC-COOKIE-1", os.urandom(16))
    file.write(b"\xff\xff" + b"".join(len(part).to_bytes(2, "big") + part for part in parts))
    file.flush()


def start_display(key):
    """A display in memory, which this names in the environment; None if there cannot be one. `key` is an open file of
    a name, which has to stay as long."""
    if not shutil.which("Xvfb"):
        return None
    give_key(key)
    reads, writes = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(writes), "-screen", "0", "1600x1200x24", "-nolisten", "tcp", "-auth", key.name],
        pass_fds=[writes],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    os.close(writes)
    with os.fdopen(reads) as told:
        number = told.readline().strip()  # nothing if it ends
    if number:
        os.environ |= {"DISPLAY": f":{number}", "XAUTHORITY": key.name, "LIBGL_ALWAYS_SOFTWARE": "1"}
    return server


def run(command, log, printed):
    """Its exit code, as a shell has it. Who asks this to stop, asks the command."""
    with open(log, "wb") as said, open(printed or os.devnull, "wb") as out:
        try:
            child = subprocess.Popen(command, stderr=said, stdout=out)
        except OSError as error:
            said.write(f"{command[0]}: {error.strerror}\n".encode())
            return 127
        for number in (signal.SIGTERM, signal.SIGINT):
            signal.signal(number, lambda got, frame: child.send_signal(got))
        code = child.wait()
    return 128 - code if code < 0 else code


def keep(record, told):
    with open(f"{record}.part", "w", encoding="utf-8") as file:
        file.write(json.dumps(told) + "\n")
    os.replace(f"{record}.part", record)


def main(arguments):
    drawn = arguments[0] == "--display"
    arguments = arguments[drawn:]
    to = arguments[1] if arguments[0] == "--to" else ""
    log, *command = arguments[2:] if to else arguments
    record = os.path.splitext(log)[0] + ".exit"
    os.makedirs(os.path.dirname(log), exist_ok=True)
    begun = {"started": time.strftime("%Y-%m-%dT%H:%M:%S%z"), "node": platform.node()}
    keep(record, begun)
    start = time.monotonic()
    # Beside X's own socket: where a job sees the one, it sees the other.
    with tempfile.NamedTemporaryFile(prefix="pneuma-display-", dir="/tmp") if drawn else contextlib.nullcontext() as key:
        display = start_display(key) if drawn else None
        code = run(command, log, f"{to}.part" if to else "")
        if display:
            display.terminate()
            display.wait()
    if to and code in (0, CHECK_FAILED):
        os.replace(f"{to}.part", to)
    elif to:
        os.remove(f"{to}.part")
    ending = {
        "exit": code,
        "seconds": round(time.monotonic() - start, 3),
        "peak_mb": round(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024 / 1e6, 1),
    }
    keep(record, ending | begun)
    with open(log, encoding="utf-8", errors="replace") as said:
        sys.stderr.write(said.read())
    return 0 if code == CHECK_FAILED else code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
