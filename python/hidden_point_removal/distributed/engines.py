"""Where the kernels run: in this process, or on a Dask cluster."""

from __future__ import annotations

import pickle
from contextlib import contextmanager

from .tiles import refuse


class Local:
    """Runs one task after another."""

    def map(self, kernel, calls, stage, progress, keep=False):
        """The results of `kernel` for each tuple of arguments. With `keep` they stay where they were computed."""
        results = []
        for number, arguments in enumerate(calls, 1):
            results.append(kernel(*arguments))
            if progress is not None:
                progress(stage, number, len(calls))
        return results

    def result(self, kept):
        return kept


class Dask:
    """Runs tasks on the workers of a client. A task that was lost with its worker is run again."""

    #: How often a task is tried again after an error, for instance of a file system.
    RETRIES = 2

    def __init__(self, client):
        self._client = client

    def map(self, kernel, calls, stage, progress, keep=False):
        from dask.distributed import as_completed

        if not calls:
            return []
        try:
            futures = self._client.map(kernel, *map(list, zip(*calls, strict=True)), retries=self.RETRIES, pure=False)
        except (TypeError, AttributeError, pickle.PicklingError) as problem:
            refuse("option", f"the tiles cannot be sent to the workers, because pickle fails: {problem}")
        for number, _ in enumerate(as_completed(futures), 1):
            if progress is not None:
                progress(stage, number, len(calls))
        # An error of a task is raised here, as it was raised there.
        return futures if keep and not _failed(futures) else self._client.gather(futures)

    def result(self, kept):
        return self._client.gather(kept)


#: So many results are put together in one task.
FAN = 256


def tree(engine, kernel, arguments, parts, stage, progress):
    """Puts parts together with `kernel(*arguments, parts)`, in a tree. The result stays where it was computed.

    So no process holds more than `FAN` parts.
    """
    while True:
        groups = [parts[start : start + FAN] for start in range(0, len(parts), FAN)] or [[]]
        parts = engine.map(kernel, [(*arguments, group) for group in groups], stage, progress, keep=True)
        if len(parts) == 1:
            return parts[0]


def _failed(futures):
    return any(future.status != "finished" for future in futures)


@contextmanager
def engine_for(client):
    if client is None:
        yield Local()
    elif hasattr(client, "submit") and hasattr(client, "gather"):
        yield Dask(client)
    else:
        refuse("option", f"client must be a dask.distributed.Client, got {type(client).__name__}")
