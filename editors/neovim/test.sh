#!/usr/bin/env bash
# Neovim as a client of `btc lsp`, set up by the very lines of docs/book/src/editors.md, without a screen. It needs `nvim` (or what `NVIM`
# names), a C compiler, and `btc` in `PATH`.
set -euo pipefail
cd "$(dirname "$0")/../.."

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# The blocks of a language under a heading of the docs.
lines_of() {
    awk -v heading="## $1" -v fence="\`\`\`$2" '
        /^## / { here = ($0 == heading) } here && $0 == fence { inside = 1; next } /^```$/ { inside = 0 } inside
    ' docs/book/src/editors.md | grep . || { echo "docs/book/src/editors.md: no $2 under $1" >&2; exit 1; }
}

export HOME="$scratch" XDG_CONFIG_HOME="$scratch/.config" XDG_DATA_HOME="$scratch/data" XDG_STATE_HOME="$scratch/state"
mkdir -p "$scratch/.config/nvim"
lines_of Neovim lua > "$scratch/.config/nvim/init.lua"
eval "$(lines_of Neovim sh)"

mkdir "$scratch/yard"
cp examples/delivery_small.bt "$scratch/yard"
# The file type alone, as Vim takes it.
found=$("${NVIM:-nvim}" --clean --headless --cmd "set runtimepath^=$PWD/editors/vim" "$scratch/yard/delivery_small.bt" \
    -c 'lua io.write(vim.bo.filetype, " ", vim.bo.commentstring)' -c qall 2>&1)
[ "$found" = "behaviortree // %s" ] || { echo "editors/vim: $found" >&2; exit 1; }

timeout 120 "${NVIM:-nvim}" --headless -n "$scratch/yard/delivery_small.bt" -c "luafile editors/neovim/test.lua" 2>&1
