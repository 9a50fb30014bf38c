#!/usr/bin/env bash
# Makes docs/book/src/paper.md: section VIII of the paper beside what btc does today, from real runs, in a few minutes.
#
#   cargo build --release && docs/paper.sh > docs/book/src/paper.md
#
# To be run from the root of the repository; BTC names another binary. The figures of the paper are written here, ours never.
set -euo pipefail

BTC=${BTC:-target/release/btc}
SMALL=examples/delivery_small.bt
LARGE=examples/delivery_large.bt
SEEDS="1 2 3 4 5"
EPISODES=200

runs=$(mktemp -d)
trap 'rm -rf "$runs"' EXIT

# learn NAME PROGRAM OPTION…: one run. A claim that fails ends it with 1, and is for the page to tell.
learn() {
    local name=$1 status=0
    shift
    "$BTC" learn --report "$@" -o "$runs/$name" > "$runs/$name.bt" 2> "$runs/$name.txt" || status=$?
    if [ "$status" -gt 1 ] || [ ! -e "$runs/$name/policy.csv" ]; then
        echo "btc learn $* did not end:" >&2
        echo "$(< "$runs/$name.txt")" >&2
        exit 1
    fi
}

# report NAME AWK: what an awk program finds in the report of a run, where `part` is 2 from the figures of the grown tree on.
report() { awk 'BEGIN { part = 1 } $1 == "grown" { part = 2 }'"$2" "$runs/$1.txt"; }

# tree NAME FILE: the tree of that name, without its doc comment.
tree() { awk -v head="tree $1 for" 'index($0, head) == 1 { on = 1 } on { print } on && /^}/ { exit }' "$2"; }

# guards FILE: the distinct guards of the tree that was printed, in its order.
guards() {
    awk '/^tree/ { next } /=>/ {
        parts = split($0, part, / *=> */)
        for (i = 1; i < parts; i++) {
            guard = part[i]; sub(/.*[{,] */, "", guard); sub(/^ */, "", guard)
            if (!(guard in met)) { met[guard]; list = list (list ? ", " : "") "`" guard "`" }
        }
    } END { print list }' "$1"
}

# places BEHAVIOUR FILE: the units of the grown tree, numbered in their order, in which a behaviour stands.
places() {
    awk -v leaf="$1" '
        /^tree/ { next }
        /^    [^ }]/ { unit++; text = "" }
        /^    / {
            line = $0; sub(/^ */, "", line); text = text (text ? " " : "") line
            if (line ~ /,$/ && $0 ~ /^    [^ ]/) {
                sub(/,$/, "", text)
                if (index(text, leaf)) list = list (list ? "; " : "") unit ". `" text "`"
            }
        }
        END { print list ? list : "nowhere" }' "$2"
}

# overlap BEHAVIOUR GUARD: in how many of the minterms of seed 1 the guard holds, the policy decides so, and both.
# The guard is an awk condition on A, B, C (visible), carrying, low and gone (`done(goto(C))`).
overlap() {
    awk -F, -v leaf="$1" '
        NR == 1 { for (i = 1; i <= NF; i++) column[$i] = i; next }
        {
            A = $column["vis(A)"]; B = $column["vis(B)"]; C = $column["vis(C)"]; gone = $column["done(goto(C))"]
            carrying = $column["carrying_package"]; low = $column["battery_low"]
            holds = ('"$2"') ? 1 : 0; decides = $column["behavior"] == leaf
            guard += holds; ours += decides; both += holds && decides
        }
        END { printf "%d | %d | %d", guard, ours, both }' "$runs/large_1/policy.csv"
}

# both NAME: the exact tree of a run and the grown one, if it is another.
both() {
    echo "// Exact, proved $(report "$1" '$1 == "proved" { sub(/^proved */, ""); print }')."
    if grep -q '^tree learned_exact for' "$runs/$1/learned.bt"; then
        tree learned_exact "$runs/$1/learned.bt"
        echo "// Grown from it: tested, not proved."
    else
        echo "// No tree that was grown from it was taken."
    fi
    tree learned "$runs/$1.bt"
}

# hand TREE: the deliveries in 1000 ticks, their interval, the deaths and the episodes of a tree by hand.
hand() {
    awk '{ gsub(/[",:]/, "") }
        $1 == "episodes" { episodes = $2 }
        $2 == "{" { at = $1 }
        $1 == "ended" { ending = 1 }
        at == "dropoff" && $1 == "per_1000_ticks" { rate = $2 }
        at == "dropoff" && $1 == "ci95" { bound = 1; next }
        bound && NF == 1 { end[bound++] = $1; if (bound > 2) bound = 0 }
        ending && at == "dead" && $1 == "count" { dead = $2 }
        END { printf "%.3f %.3f %.3f %d %d\n", rate, end[1], end[2], dead, episodes }' "$runs/$1.json"
}

for seed in $SEEDS; do
    learn "small_$seed" "$SMALL" --shape exact --seed "$seed"
    learn "large_$seed" "$LARGE" --seed "$seed"
done
best=0
for name in expert table_1 table_1_wander; do
    "$BTC" run "$LARGE" --tree "$name" --episodes "$EPISODES" --format json > "$runs/$name.json"
    best=$(hand "$name" | awk -v best="$best" '{ print ($1 > best + 0 ? $1 : best) }')
done
simple="$runs/large_1.bt"

echo "# The paper, beside what btc does

Section VIII of Bikramjit Banerjee, *Autonomous Acquisition of Behavior Trees for Robot Control*, IROS 2018, item by item, beside
real runs of $("$BTC" --version). The page is made by \`cargo build --release && docs/paper.sh > docs/book/src/paper.md\` in a few minutes
and not edited by hand: every figure of ours comes out of a command that is named beside it.
The worlds are not the same. The paper's robot runs in Gazebo, ours in [\`$SMALL\`](../../../$SMALL)
and [\`$LARGE\`](../../../$LARGE), with measures and control laws of their own. The paper gives no
rate of deliveries or deaths, and nothing over several seeds, so these columns are ours alone.

## Minterms seen

The combinations of predicates that the learner met; all others are don't-cares. Ours: \`btc learn PROGRAM --seed N\`.

| | predicates | paper | btc, seeds $SEEDS |
| --- | --- | --- | --- |
| small (VIII-A) | 6 | 10 | $(for s in $SEEDS; do report "small_$s" '$1 == "learned" { printf "%s ", $2 }'; done)|
| large (VIII-B) | 11 | 61 | $(for s in $SEEDS; do report "large_$s" '$1 == "learned" { printf "%s ", $2 }'; done)|

## Figure 8: the small delivery

Figure 8 is a drawing; \`expert\` in the program is how we write it. \`btc learn $SMALL --seed 1\`:

\`\`\`bt
$(tree learned "$runs/small_1.bt")
\`\`\`

| seed | tree | nodes | \`claim learned equals expert\` | deliveries in 1000 ticks | deaths |
| --- | --- | --- | --- | --- | --- |"
first=$(tree learned "$runs/small_1.bt")
for seed in $SEEDS; do
    same="another"
    if [ "$(tree learned "$runs/small_$seed.bt")" = "$first" ]; then same="as above"; fi
    report "small_$seed" '
        $1 == "tree" { nodes = $2 }
        $1 == "dropoff" { rate = $2; sub(/,/, "", rate) }
        $1 == "ended" { deaths = $2 " of " $4 }
        /`learned` and `expert`/ { verdict = $0; sub(/^.*behaviour on/, "equal on", verdict) }
        END { printf "| '"$seed | $same"' | %s | %s | %s | %s |\n", nodes, verdict ? verdict : "no verdict", rate, deaths }'
done

echo "
## Table I: the large delivery, guard by guard

\`\`\`bt
// btc learn $LARGE --seed 1
$(both large_1)
\`\`\`

The guards of Table I are an unordered set of tests; the units of a tree are tried from the first to the last, so each of ours
also says that no unit before it holds. \`V\` is vis, \`P\` carrying_package, \`L\` battery_low, \`D\` done(goto(C)). As printed, goto(B)
waits for a low battery; a bar over \`L\` seems to be lost, so both readings are shown. The last three columns count among the
$(report large_1 '$1 == "learned" { print $2 }') minterms that seed 1 learned (\`policy.csv\`): where the paper's guard holds, where our policy decides so, and both.

| behaviour | guard in Table I | the last of our trees reaches it in unit | guard holds | ours | both |
| --- | --- | --- | --- | --- | --- |"
while IFS=';' read -r behavior guard condition; do
    echo "| \`$behavior\` | $guard | $(places "$behavior" "$simple") | $(overlap "$behavior" "$condition") |"
done << 'TABLE'
goto(A);V(A) ∧ ¬P ∧ ¬L;A && !carrying && !low
goto(B);V(B) ∧ P ∧ L, as printed;B && carrying && low
goto(B);V(B) ∧ P ∧ ¬L, with the bar;B && carrying && !low
goto(C);¬D ∧ V(C) ∧ L;!gone && C && low
dock(C);D ∧ V(C) ∧ L;gone && C && low
follow_wall;(¬V(B) ∧ P ∧ ¬L) ∨ (¬V(C) ∧ (L ∨ P)) ∨ (¬V(A) ∧ ¬P ∧ ¬L);(!B && carrying && !low) || (!C && (low || carrying)) || (!A && !carrying && !low)
wander;V(C) ∧ ¬V(B) ∧ P ∧ ¬L;C && !B && carrying && !low
TABLE

echo "
## Figure 9: the tree made readable

The paper's tree has five tests: t1 = \`battery_low and vis(C)\`, t2 = \`carrying_package\`, t3 = \`vis(A)\`, t4 = \`vis(B)\`,
t5 = \`carrying_package and vis(C)\`. The tests of our grown trees, and the nodes of the tree that Algorithm 1 alone makes of
the policy, of the smallest that a search finds from there (exact), and of the grown one; below, the trees of seeds 2 to 5:

| seed | tests | Algorithm 1 | exact | grown |
| --- | --- | --- | --- | --- |"
for seed in $SEEDS; do
    report "large_$seed" '
        $1 == "tree" { exact = $2; alone = $(NF - 1) }
        $1 == "grown" { simple = $2 == "no" ? "the exact one" : $2 }
        END { printf "| '"$seed | $(guards "$runs/large_$seed.bt")"' | %s | %s | %s |\n", alone, exact, simple }'
done
echo
echo '```bt'
for seed in $SEEDS; do
    if [ "$seed" != 1 ]; then echo "// seed $seed"; tree learned "$runs/large_$seed.bt"; fi
done
echo '```'

echo "
## How well they do

Trees by hand, from the program: \`expert\` is what a person would write, \`table_1\` the paper's Table I with the bar put back and
without its wander unit, \`table_1_wander\` with that unit before wall following.
\`btc run $LARGE --tree NAME --episodes $EPISODES --format json\`:

| tree | deliveries in 1000 ticks | 95 % interval | deaths |
| --- | --- | --- | --- |"
for name in expert table_1 table_1_wander; do
    hand "$name" | awk -v name="$name" '{ printf "| `%s` | %s | %s to %s | %s of %s |\n", name, $1, $2, $3, $4, $5 }'
done
echo "
Learned: \`btc learn $LARGE --seed N\`. Each pair is exact / grown, on the same
fresh episodes; the percentage is of the $best deliveries of the best tree by hand in its own $EPISODES episodes. *Reached* are the
minterms that the greedy policy meets, on which the exact tree is proved; *closed* says whether btc reports the proof as closed under the transitions that were met.

| seed | minterms seen / reached | closed | nodes | return | deliveries in 1000 ticks | of the best by hand | deaths |
| --- | --- | --- | --- | --- | --- | --- | --- |"
for seed in $SEEDS; do
    report "large_$seed" '
        $1 == "learned" { seen = $2 }
        $1 == "proved" { reached = $3; closed = /not closed/ ? "no" : "yes" }
        $1 == "tree" { exact = $2 }
        $1 == "grown" { nodes = exact " / " ($2 == "no" ? exact : $2) }
        part == 2 && $1 == "return" { gained = $6 " / " $2; gsub(/,/, "", gained) }
        part == 2 && $1 == "dropoff" { rate = $9 " / " $2; share = sprintf("%.1f %% / %.1f %%", 100 * $9 / '"$best"', 100 * $2 / '"$best"') }
        part == 2 && $1 == "ended" { deaths = $NF " / " $2 " of " $4 }
        END { printf "| '"$seed"' | %s / %s | %s | %s | %s | %s | %s | %s |\n", seen, reached, closed, nodes, gained, rate, share, deaths }'
done
