"""What this plugin announces; light, so that listing components does not import dask."""

from __future__ import annotations

from grammarbt.plugins import ExecutorSpec, hookimpl

GRAMMARBT_API = 1


@hookimpl
def grammarbt_executors() -> list[ExecutorSpec]:
    """The executor on dask.distributed."""
    return [
        ExecutorSpec(
            name="dask",
            factory="grammarbt_dask.executor:make_dask",
            parameters="grammarbt_dask.parameters:DaskParameters",
            help="Simulates on dask.distributed: worker processes here, or a cluster given by its address.",
        )
    ]
