"""Options that several verbs have."""

from __future__ import annotations

import click

json_option = click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")

quiet_option = click.option("--quiet", is_flag=True, help="Show no progress.")

domain_settings = click.option(
    "--set", "settings", multiple=True, metavar="domain.KEY=VALUE", help="A parameter of it; repeatable."
)
"""Where a verb has a domain and no other part with parameters."""

worlds_option = click.option("--seed", type=int, metavar="N", help="Which worlds; 0 unless given.")
"""Where a tree is measured as a run of that seed would validate it."""
