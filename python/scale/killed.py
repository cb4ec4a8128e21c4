"""Ends processes with SIGKILL in the middle of a stage."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time


class Killer(threading.Thread):
    """Ends the first worker that is seen at work on a task of a kernel."""

    def __init__(self, client, kernel):
        super().__init__(daemon=True)
        self._client = client
        self._kernel = kernel
        self._ended = threading.Event()
        self._pids = client.run(os.getpid)
        #: The task that was lost, if any.
        self.hit = None

    def run(self):
        while self.hit is None and not self._ended.is_set():
            for worker, tasks in self._client.processing().items():
                own = [str(task) for task in tasks if str(task).startswith(f"{self._kernel}-")]
                if own and worker in self._pids:
                    os.kill(self._pids[worker], signal.SIGKILL)
                    self.hit = own[0]
                    break
            time.sleep(0.002)

    def end(self):
        self._ended.set()
        self.join()


def command(folder, cameras, output, *options):
    """The command of the package, as a process."""
    words = ["-m", "hidden_point_removal.command", str(folder), "--from", str(cameras), "-o", str(output)]
    return subprocess.Popen([sys.executable, *words, *options], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def kill_when_kept(process, work, tiles):
    """Ends the command when so many tiles are finished. Returns how many are kept; 0 if it was over before."""
    while process.poll() is None:
        kept = len([*work.glob("*/*.npz")])
        if kept >= tiles:
            process.kill()
            process.communicate()
            return len([*work.glob("*/*.npz")])
        time.sleep(0.01)
    return 0
