"""Where the kernels run: in this process, or on a Dask cluster."""

from __future__ import annotations

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

        futures = [self._client.submit(kernel, *arguments, retries=self.RETRIES, pure=False) for arguments in calls]
        for number, _ in enumerate(as_completed(futures), 1):
            if progress is not None:
                progress(stage, number, len(calls))
        # An error of a task is raised here, as it was raised there.
        return futures if keep and not _failed(futures) else self._client.gather(futures)

    def result(self, kept):
        return self._client.gather(kept)


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
