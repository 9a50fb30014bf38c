#!/usr/bin/env bash
# Prints the tables of docs/book/src/peers.md: btc beside dtControl and PAYNT on the same policies, in about half an hour.
#
#   cargo build --release && docs/peers.sh > peers.txt
#
# To be run from the root of the repository; BTC names another binary. The peers are installed from PyPI into environments of
# their own: that takes Python 3.9 to 3.11, and what compiles C for one of dtControl's presets, which is left out otherwise.
# Environments, policies and results in the folder that PEERS names are used again; POLICIES names some policies only.
set -euo pipefail

BTC=${BTC:-target/release/btc}
PYTHON=${PYTHON:-python3}

peers=${PEERS:-$(mktemp -d)}
[ -n "${PEERS:-}" ] || trap 'rm -rf "$peers"' EXIT

# install NAME PACKAGE…: an environment with these packages.
install() {
    local name=$1
    shift
    [ ! -e "$peers/$name.installed" ] || return 0
    "$PYTHON" -m venv "$peers/$name"
    "$peers/$name/bin/pip" install --quiet --disable-pip-version-check "$@" >&2
    touch "$peers/$name.installed"
}

# dtControl names lower bounds of what it needs, but later releases have dropped calls of which it makes use; and it needs two
# packages that it does not name, psutil and setuptools.
install dtcontrol dtcontrol==2.1.15 numpy==1.26.4 scipy==1.11.4 pandas==1.5.3 scikit-learn==1.2.2 psutil==7.2.2 setuptools==80.9.0
install paynt paynt==0.5.0 stormpy==2.0.0

# The C of its preset `oc1` is compiled on use; today's compilers have to be told to allow what was usual then.
export MAKEFLAGS='CFLAGS=-O3\ -w\ -fcommon'

"$PYTHON" docs/peers.py "$BTC" "$peers" ${POLICIES:-}
