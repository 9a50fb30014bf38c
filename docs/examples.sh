#!/usr/bin/env bash
# Makes docs/book/src/examples.md and its pictures: what is learned of each example, on five seeds, beside its tree by hand.
#
#   cargo build --release && docs/examples.sh > docs/book/src/examples.md
#
# To be run from the root of the repository; BTC names another binary. Results in the folder that RUNS names are used again.
set -euo pipefail

BTC=${BTC:-target/release/btc}
EXAMPLES="rooms foraging guard grasp warehouse vacuum"
SEEDS="1 2 3 4 5"
EPISODES=500

runs=${RUNS:-$(mktemp -d)}
[ -n "${RUNS:-}" ] || trap 'rm -rf "$runs"' EXIT

# learn NAME SEED: one run. A claim that fails or is undecided ends it with 1 or 3, and is for the page to tell.
learn() {
    local status=0
    [ ! -e "$runs/$1.$2.txt" ] || return 0
    "$BTC" learn "examples/$1.bt" --seed "$2" -o "$runs/$1.$2" > "$runs/part.bt" 2> "$runs/part.txt" || status=$?
    if [ "$status" = 2 ] || ! grep -q '^return ' "$runs/part.txt"; then
        echo "btc learn examples/$1.bt --seed $2 did not end:" >&2
        echo "$(< "$runs/part.txt")" >&2
        exit 1
    fi
    mv "$runs/part.bt" "$runs/$1.$2.bt"
    mv "$runs/part.txt" "$runs/$1.$2.txt"
}

# title NAME: the first sentence of an example, without its mark.
title() { awk '/^\/\/!/ { sub(/^\/\/! */, ""); text = text (text ? " " : "") $0; next } { exit } END { sub(/[.:].*/, "", text); print text }' "examples/$1.bt"; }

# returned FILE: the return that a run printed.
returned() { awk '$1 == "return" { sub(/,$/, "", $2); print $2; exit }' "$1"; }

# exact FILE: the return of the exact tree, from the figures of a run.
exact() { awk '/"before": \{/ { on = 1 } on && /"return": \{/ { on = 2 } on == 2 && /"mean":/ { gsub(/[",]/, ""); printf "%.3f", $2; exit }' "$1"; }

echo "# The examples"
echo
echo "<!-- Made by docs/examples.sh from real runs. -->"
echo
echo "Each example has a tree by hand, and is learned on the seeds 1 to 5: \`btc learn examples/NAME.bt --seed N\`. The *exact* tree is"
echo "learned without the tree by hand, and proved equal to the policy on the transitions that were recorded. The *grown* tree is"
echo "searched for from there, and is tested; the tree by hand is among the trees that this search begins with. Returns are means over $EPISODES"
echo "fresh episodes from the task's own starts; the share is that of the return by hand. \`docs/examples.sh\` makes this page."
echo
echo "| example | seed | nodes by hand | of the exact tree | of the grown tree | return by hand | of the exact tree | of the grown tree | share |"
echo "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
for name in $EXAMPLES; do
    by_hand=$("$BTC" run "examples/$name.bt" --tree hand --episodes "$EPISODES" | awk '$1 == "return" { print $2 }')
    nodes=$("$BTC" size "examples/$name.bt" | awk '$1 == "hand" { print $2 }')
    for seed in $SEEDS; do
        learn "$name" "$seed"
        learned=$(returned "$runs/$name.$seed.txt")
        sizes=$(awk '$1 == "tree" { exact = $2; if (match($0, /proved, has [0-9]+/)) { exact = substr($0, RSTART + 12, RLENGTH - 12) } print exact " | " $2; exit }' "$runs/$name.$seed.txt")
        exact=$(exact "$runs/$name.$seed/metrics.json")
        share=$(awk -v a="$learned" -v b="$by_hand" 'BEGIN { printf "%.0f %%", 100 * a / b }')
        echo "| [$name](../../../examples/$name.bt) | $seed | $nodes | $sizes | $by_hand | $exact | $learned | $share |"
    done
done

for name in $EXAMPLES; do
    "$BTC" run "examples/$name.bt" --tree hand --episodes 1 --svg "docs/book/src/example.$name.svg" --svg-ticks 600 > "$runs/part.txt"
    echo
    echo "## $(title "$name")"
    echo
    echo "![The tree by hand at work](example.$name.svg)"
    echo
    echo "Learned on seed 1:"
    echo
    echo '```'
    awk '/^tree/ { on = 1 } on { print } on && (/^}/ || !/{$/ && NR == 1) { exit }' "$runs/$name.1.bt"
    echo '```'
    echo
    echo "What its claims come to, on the tree by hand and, where they are about it, on what was learned on seed 1:"
    echo
    echo '```'
    "$BTC" verify --root . "$runs/$name.1/learned.bt" 2> /dev/null || true
    echo '```'
done
