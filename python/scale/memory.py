"""The memory and the time of this process."""

import time
from pathlib import Path


def peak_memory():
    """The most memory that this process held, in MB; NaN where the system does not say.

    `ru_maxrss` would not do: a process inherits it from the process that started it.
    """
    try:
        lines = Path("/proc/self/status").read_text().splitlines()
    except OSError:
        return float("nan")
    return next((int(line.split()[1]) / 1024 for line in lines if line.startswith("VmHWM")), float("nan"))


def processor_time():
    """The processor time of this process, in seconds."""
    return time.process_time()
