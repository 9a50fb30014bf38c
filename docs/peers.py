"""What docs/peers.sh runs: makes the policies, runs btc, dtControl and PAYNT on them, checks each tree on each row.

    peers.py BTC FOLDER [POLICY…]    FOLDER holds the environments `dtcontrol` and `paynt`

Without POLICY all of them. Nothing here draws a number at random but by a generator that is written out below.
"""

import json
import os
import re
import signal
import subprocess
import sys
import time
from fractions import Fraction
from itertools import product
from pathlib import Path

# The presets of dtControl, by what their inner nodes ask: one number, or a sum of several.
# Two are left out: `sos-safepruning` fails when it writes the tree as JSON, `linear-auroc` takes minutes for trees that are larger.
AXIS = ["cart", "maxfreq", "minnorm", "mlentropy"]
LINEAR = ["logreg", "linsvm", "maxfreqlc", "minnormlc", "oc1"]

# Seconds that a run may take.
LIMIT = 60

# The deepest trees that PAYNT looks for: a tree of depth d is searched for among all with 2^d leaves.
DEPTH = 8

# Ten times the work that `btc decanonicalize` does unasked.
EFFORT = 200


# --- Policies -------------------------------------------------------------------------------------------------------------


class Policy:
    """Inputs with a name each, and rows: values, and the actions that are allowed there."""

    def __init__(self, name, inputs, rows, truth=(), outputs=1, model=None):
        self.name = name
        self.inputs = inputs
        # Values are numbers, actions are texts, or tuples of numbers for dtControl's permissive controllers.
        self.rows = rows
        # The inputs that are truth values.
        self.truth = set(truth)
        self.outputs = outputs
        # The Markov decision process behind it.
        self.model = model
        # What btc reads, where that is not one of the two tables below.
        self.read = None

    def actions(self):
        return sorted({action for _, allowed in self.rows for action in allowed})

    def permissive(self):
        return any(len(allowed) > 1 for _, allowed in self.rows)

    def numbers(self):
        """The numbers of an action in dtControl's format, which has no others."""
        actions = self.actions()
        if isinstance(actions[0], tuple):
            return {action: action for action in actions}
        return {action: (number,) for number, action in enumerate(actions)}

    def write_dtcontrol(self, path):
        numbers = self.numbers()
        lines = ["#PERMISSIVE" if self.permissive() else "#NON-PERMISSIVE", f"#BEGIN {len(self.inputs)} {self.outputs}"]
        for values, allowed in self.rows:
            for action in sorted(allowed):
                lines.append(",".join(map(shown, values + numbers[action])))
        path.write_text("\n".join(lines) + "\n")

    def write_csv(self, path):
        header = [name if name in self.truth else f"{name}:number" for name in self.inputs]
        lines = [",".join(header + ["action"])]
        for values, allowed in self.rows:
            lines.append(",".join([*map(shown, values), "|".join(sorted(allowed))]))
        path.write_text("\n".join(lines) + "\n")


def shown(number):
    return f"{float(number):.6f}".rstrip("0").rstrip(".") if not isinstance(number, int) else str(number)


def kept(states, actions, step, safe):
    """The safety game: of the actions those from which, whatever happens, the safe states are never left."""
    after = {state: {action: set(step(state, action)) for action in actions} for state in states if safe(state)}
    while True:
        now = {}
        for state, choices in after.items():
            left = {action: ends for action, ends in choices.items() if ends <= after.keys()}
            if left:
                now[state] = left
        if now == after:
            return {state: set(choices) for state, choices in now.items()}
        after = now


def cruise():
    """A car behind a car that speeds up and brakes as it likes: keep five metres, and be as fast as that allows.

    After UPPAAL Stratego's example.
    """
    speeds, far, near = range(0, 21, 2), 120, 5

    def step(state, action):
        own, front, distance = state
        after = min(max(own + action, 0), 20)
        for push in (-2, 0, 2):
            ahead = front + push
            if 0 <= ahead <= 20:
                yield after, ahead, min(distance + (front + ahead) // 2 - (own + after) // 2, far)

    states = list(product(speeds, speeds, range(far + 1)))
    allowed = kept(states, (-2, 0, 2), step, lambda state: state[2] >= near)
    fastest = {state: {max(choices)} for state, choices in allowed.items()}
    return Policy("cruise", ["own", "front", "distance"], numbered(fastest))


def numbered(allowed):
    as_tuple = lambda action: action if isinstance(action, tuple) else (action,)
    return [(state, {as_tuple(action) for action in choices}) for state, choices in sorted(allowed.items())]


def boxes(size, count, step, actions, centre):
    """An abstraction into `count` cells each way: a step leads from a cell to all cells that its image touches."""

    def after(cell, action):
        low, high = step(tuple(i * s for i, s in zip(cell, size)), tuple((i + 1) * s for i, s in zip(cell, size)), action)
        spans = []
        for a, b, s in zip(low, high, size):
            # The image is closed: a face of a cell belongs to both sides.
            first, last = -(-a // s) - 1, b // s
            spans.append(range(int(first), int(last) + 1))
        return product(*spans)

    cells = list(product(*(range(-(n // 2), n - n // 2) for n in count)))
    inside = set(cells)
    allowed = kept(cells, actions, after, lambda cell: cell in inside)
    at = lambda cell: tuple(c + (i + Fraction(1, 2)) * s for i, s, c in zip(cell, size, centre))
    return {at(cell): choices for cell, choices in allowed.items()}


def pendulum():
    """A pendulum that stands on its head, linear: angle and speed in cells, nine torques; never let it fall."""
    size = (Fraction(1, 50), Fraction(1, 20))
    dt = Fraction(1, 10)

    def step(low, high, torque):
        ends = []
        for angle, speed in (low, high):
            # Both rows of the matrix are positive, so the image of a cell lies between those of two corners.
            ends.append((angle + dt * speed, speed + dt * (6 * angle + torque)))
        return ends

    torques = [Fraction(n, 2) for n in range(-4, 5)]
    allowed = boxes(size, (50, 60), step, torques, (0, 0))
    return Policy("pendulum", ["angle", "speed"], numbered(allowed))


def rooms():
    """Two rooms with a heater each, and a wall between them: keep both within a few degrees, heat no more than that takes.

    Two outputs.
    """
    size = (Fraction(1, 10), Fraction(1, 10))

    def step(low, high, heat):
        ends = []
        for one, two in (low, high):
            # Around 20 degrees; 2 degrees outside.
            after = lambda own, other, power: own + (other - own) / 20 + (-18 - own) / 50 + power * Fraction(1, 2)
            ends.append((after(one, two, heat[0]), after(two, one, heat[1])))
        return ends

    powers = list(product((Fraction(0), Fraction(1, 2), Fraction(1), Fraction(3, 2)), repeat=2))
    allowed = boxes(size, (24, 24), step, powers, (20, 20))
    least = {state: {action for action in choices if sum(action) == min(map(sum, choices))} for state, choices in allowed.items()}
    return Policy("rooms", ["one", "two"], numbered(least), outputs=2)


WALLS = [((4, y), y not in (2, 13)) for y in range(16)] + [((x, 8), x not in (1, 10)) for x in range(16)] + [((11, y), y not in (5, 12)) for y in range(16)]


def maze():
    """Sixteen by sixteen fields with three walls that have two doors each: every move that lies on a shortest way is allowed."""
    blocked = {field for field, there in WALLS if there}
    free = [field for field in product(range(16), repeat=2) if field not in blocked]
    moves = {0: (1, 0), 1: (0, 1), 2: (-1, 0), 3: (0, -1)}
    distance = {(15, 15): 0}
    ring = [(15, 15)]
    while ring:
        nearer, ring = ring, []
        for x, y in nearer:
            for dx, dy in moves.values():
                field = (x + dx, y + dy)
                if field in free and field not in distance:
                    distance[field] = distance[(x, y)] + 1
                    ring.append(field)
    allowed = {}
    for x, y in free:
        ways = {number for number, (dx, dy) in moves.items() if distance.get((x + dx, y + dy), 10**9) < distance[(x, y)]}
        if ways:
            allowed[(x, y)] = ways
    return Policy("maze", ["x", "y"], numbered(allowed))


def drawn(seed):
    """A generator of our own, so that a table is the same everywhere: 32 bits of a linear congruence of 64."""
    state = seed
    while True:
        state = (state * 6364136223846793005 + 1442695040888963407) % 2**64
        yield state >> 32


RULES = [
    ("stop", "bumped or fault"),
    ("charge", "battery_low and at_dock"),
    ("dock", "battery_low and dock_seen"),
    ("search", "battery_low"),
    ("wait", "person_near and not path_clear"),
    ("drop", "carrying and at_goal"),
    ("carry", "carrying and path_clear"),
    ("detour", "carrying"),
    ("pick", "parcel_near and not person_near"),
    ("approach", "parcel_seen and path_clear"),
    ("detour", "parcel_seen"),
    ("charge", "at_dock and idle_long"),
    ("wander", "True"),
]


def robot():
    """All minterms of twelve predicates, decided by a list of rules as a person writes it."""
    names = sorted(set(re.findall(r"[a-z_]+", " ".join(guard for _, guard in RULES))) - {"and", "or", "not"})
    names = [name for name in names if name != "rue"]
    rows = []
    for values in product((0, 1), repeat=len(names)):
        held = dict(zip(names, values))
        action = next(action for action, guard in RULES if eval(guard, {}, held))
        rows.append((values, {action}))
    return Policy("robot", names, rows, truth=names)


def planted():
    """A thousand drawn rows of twenty-four predicates, decided by nine drawn rules of two to four literals."""
    numbers = drawn(7)
    names = [f"p{i}" for i in range(24)]
    rules = []
    for rule in range(9):
        literals = {next(numbers) % 24: next(numbers) % 2 for _ in range(2 + next(numbers) % 3)}
        rules.append((literals, f"b{next(numbers) % 5}"))
    rows = {}
    while len(rows) < 1000:
        values = tuple(next(numbers) % 2 for _ in names)
        rows[values] = {next((action for literals, action in rules if all(values[i] == v for i, v in literals.items())), "b5")}
    return Policy("planted", names, sorted(rows.items()), truth=names)


# --- Markov decision processes, by Storm ----------------------------------------------------------------------------------

# Every action may be taken in every state; where it is of no use it does nothing. PAYNT plays dice where a tree names another.
MODELS = {
    # A robot that fetches a parcel: two walls with a door each, a step fails once in ten.
    "fetch": """mdp
        formula east_free = x<9 & !(x=2 & y!=2) & !(x=5 & y!=6);
        formula west_free = x>0 & !(x=4 & y!=2) & !(x=7 & y!=6);
        formula door = x=3 | x=6;
        module robot
            x : [0..9] init 0;
            y : [0..7] init 0;
            loaded : bool init false;
            over : bool init false;
            [east]  !over -> 0.9 : (x'=east_free ? x+1 : x) + 0.1 : true;
            [west]  !over -> 0.9 : (x'=west_free ? x-1 : x) + 0.1 : true;
            [north] !over -> 0.9 : (y'=y<7 & !door ? y+1 : y) + 0.1 : true;
            [south] !over -> 0.9 : (y'=y>0 & !door ? y-1 : y) + 0.1 : true;
            [pick]  !over -> (loaded'=loaded | (x=9 & y=0));
            [drop]  !over -> (over'=loaded & x=0 & y=7);
        endmodule
        rewards [east] true : 1; [west] true : 1; [north] true : 1; [south] true : 1; [pick] true : 1; [drop] true : 1; endrewards
        label "done" = over;
    """,
    # A robot in a corridor that brings three parcels and has to charge in time; with an empty battery it is towed away.
    "charge": """mdp
        module robot
            at : [0..8] init 0;
            battery : [1..20] init 20;
            brought : [0..3] init 0;
            loaded : bool init false;
            [right]  brought<3 & battery>1 -> 0.8 : (at'=min(at+1, 8)) & (battery'=battery-1) + 0.2 : (battery'=battery-1);
            [right]  brought<3 & battery=1 -> (battery'=20) & (at'=3);
            [left]   brought<3 & battery>1 -> 0.8 : (at'=max(at-1, 0)) & (battery'=battery-1) + 0.2 : (battery'=battery-1);
            [left]   brought<3 & battery=1 -> (battery'=20) & (at'=3);
            [pick]   brought<3 -> (loaded'=loaded | at=8);
            [drop]   brought<3 -> (loaded'=loaded & at!=1) & (brought'=loaded & at=1 ? brought+1 : brought);
            [charge] brought<3 -> (battery'=at=3 ? min(battery+5, 20) : battery);
        endmodule
        rewards
            [right] battery>1 : 1; [right] battery=1 : 60; [left] battery>1 : 1; [left] battery=1 : 60;
            [pick] true : 1; [drop] true : 1; [charge] true : 2;
        endrewards
        label "done" = brought=3;
    """,
    # A machine with two queues that sleeps or serves one of them: power and waiting cost; it is switched off at a random time.
    "queues": """mdp
        module machine
            awake : bool init false;
            off : bool init false;
            [sleep] !off -> 0.98 : (awake'=false) + 0.02 : (off'=true);
            [wake]  !off -> 0.49 : (awake'=true) + 0.49 : true + 0.02 : (off'=true);
            [first] !off -> 0.98 : true + 0.02 : (off'=true);
            [other] !off -> 0.98 : true + 0.02 : (off'=true);
        endmodule
        module first
            a : [0..7] init 0;
            [sleep] true -> 0.3 : (a'=min(a+1, 7)) + 0.7 : true;
            [wake]  true -> 0.3 : (a'=min(a+1, 7)) + 0.7 : true;
            [first] true -> 0.3 : (a'=awake ? max(a, 1) : min(a+1, 7)) + 0.7 : (a'=awake ? max(a-1, 0) : a);
            [other] true -> 0.3 : (a'=min(a+1, 7)) + 0.7 : true;
        endmodule
        module other
            b : [0..7] init 0;
            [sleep] true -> 0.2 : (b'=min(b+1, 7)) + 0.8 : true;
            [wake]  true -> 0.2 : (b'=min(b+1, 7)) + 0.8 : true;
            [first] true -> 0.2 : (b'=min(b+1, 7)) + 0.8 : true;
            [other] true -> 0.2 : (b'=awake ? max(b, 1) : min(b+1, 7)) + 0.8 : (b'=awake ? max(b-1, 0) : b);
        endmodule
        rewards
            [sleep] true : a + 2*b; [wake] true : a + 2*b + 5; [first] true : a + 2*b + 3; [other] true : a + 2*b + 3;
        endrewards
        label "done" = off;
    """,
    # The grid of Storm's own examples, eight by eight instead of four by four.
    "slipgrid": """mdp
        const double p = 0.4;
        const int N = 8;
        const int M = 8;
        module grid
            x : [1..N] init 1;
            y : [1..M] init 1;
            [north] true -> 1-p: (x'=max(x-1, 1)) + p: (x'=x);
            [south] true -> 1-p: (x'=min(x+1, N)) + p: (x'=x);
            [east] true -> 1-p: (y'=max(y-1, 1)) + p: (x'=x);
            [west] true -> 1-p: (y'=min(y+1, M)) + p: (x'=x);
        endmodule
        rewards [east] true : 1; [west] true : 1; [north] true : 1; [south] true : 1; endrewards
        label "done" = x=N & y=M;
    """,
}
FORMULA = 'Rmin=? [F "done"]'


def storm(project):
    """Runs in the environment of PAYNT: Storm solves the model exactly, its scheduler and all that we need go to files."""
    import stormpy

    program = stormpy.parse_prism_program(str(project / "sketch.templ"))
    (wanted,) = stormpy.parse_properties(FORMULA, program)
    options = stormpy.BuilderOptions([wanted.get_raw_formula()])
    options.set_build_state_valuations(True)
    options.set_build_choice_origins(True)
    options.set_build_choice_labels(True)
    options.set_build_all_labels(True)
    options.set_build_all_reward_models(True)
    model = stormpy.build_model[stormpy.Rational](program, options=options)
    result = stormpy.model_checking(model, wanted, extract_scheduler=True)
    scheduler = result.get_scheduler()
    (project / "scheduler.json").write_text(scheduler.to_json_str(model))
    exact = lambda number: str(number)
    (costs,) = model.reward_models.values()
    done = model.labeling.get_states("done")
    states = []
    for state in model.states:
        valuation = json.loads(str(model.state_valuations.to_json(state.id)))
        choices = []
        first = model.get_choice_index(state.id, 0)
        for action in state.actions:
            choice = first + action.id
            cost = Fraction(0)
            if costs.has_state_action_rewards:
                cost += Fraction(exact(costs.get_state_action_reward(choice)))
            if costs.has_state_rewards:
                cost += Fraction(exact(costs.get_state_reward(state.id)))
            # Storm replaces the choices of a state that it need not explore by a loop without a name.
            label = next(iter(model.choice_labeling.get_labels_of_choice(choice)), "")
            after = [[move.column, exact(move.value)] for move in action.transitions]
            choices.append({"label": label, "cost": str(cost), "after": after})
        chosen = scheduler.get_choice(state.id).get_deterministic_choice()
        states.append(
            {
                "values": valuation,
                "choices": choices,
                "chosen": choices[chosen]["label"],
                "value": exact(result.get_value(state.id)),
                "done": done.get(state.id),
            }
        )
    (project / "model.json").write_text(json.dumps({"initial": model.initial_states[0], "states": states}))


def mapped(project):
    """Runs in the environment of PAYNT: its search for the tree of least depth that maps the scheduler.

    Its command has `--tree-map-scheduler` for this, but ends in an error as soon as the scheduler meets a state with one action.
    """
    import paynt.dt.synthesizer
    import paynt.model.model
    import paynt.parser.sketch
    import paynt.utils.timer
    from paynt.dt._utils import get_state_valuations

    paynt.utils.timer.GlobalTimer.start(LIMIT)
    factory, task = paynt.parser.sketch.Sketch.load_sketch(
        str(project / "sketch.templ"), str(project / "sketch.props"), task_kwargs={"tree_depth": DEPTH, "add_dont_care_action": False}
    )
    chosen = {state_key(entry["s"]): entry["c"][0]["labels"] for entry in json.loads((project / "scheduler.json").read_text())}
    model = factory.underlying_mdp
    names, valuations = get_state_valuations(model)
    starts = model.nondeterministic_choice_indices.copy()
    choices = []
    for state, valuation in enumerate(valuations):
        labels = chosen[state_key(dict(zip(names, valuation)))]
        actions = [factory.action_labels[factory.choice_to_action[choice]] for choice in range(starts[state], starts[state + 1])]
        choices.append(starts[state] + (actions.index(labels[0]) if labels and len(actions) > 1 else 0))
    index = paynt.model.model.ModelIndex
    choices = index.discard_unreachable_choices(model, factory.choice_destinations, choices)
    synthesizer = paynt.dt.synthesizer.DtSynthesizer(factory, task)
    synthesizer.map_scheduler(index.state_to_choice_to_choices(model, choices), DEPTH)
    tree = synthesizer.best_tree
    if tree:
        info = synthesizer.colored_mdp.feature_info
        tree.simplify([info.relevant_state_valuations[state] for state in info.state_is_relevant_bv])
        print(f"printing the synthesized tree below:\n{tree.to_string()}")
    print(f"synthesis finished after {paynt.utils.timer.GlobalTimer.read():.2f} seconds")


def state_key(valuation):
    return json.dumps(valuation, sort_keys=True)


class Model:
    """A Markov decision process as Storm built and solved it."""

    def __init__(self, folder, name):
        self.project = folder / "models" / name
        self.project.mkdir(parents=True, exist_ok=True)
        (self.project / "sketch.templ").write_text(re.sub(r"(?m)^ {4}", "", MODELS[name]))
        (self.project / "sketch.props").write_text(FORMULA + "\n")
        if not (self.project / "model.json").exists():
            subprocess.run([folder / "paynt/bin/python", __file__, "--storm", self.project], check=True)
        read = json.loads((self.project / "model.json").read_text())
        self.initial, self.states = read["initial"], read["states"]
        self.inputs = list(self.states[0]["values"])
        for state in self.states:
            state["value"] = Fraction(state["value"])
            for choice in state["choices"]:
                choice["cost"] = Fraction(choice["cost"])
                choice["after"] = [(after, Fraction(share)) for after, share in choice["after"]]
        self.truth = {name for name, value in self.states[0]["values"].items() if isinstance(value, bool)}

    def values(self, state):
        return tuple(int(state["values"][name]) for name in self.inputs)

    def asks(self, state):
        """Whether there is anything to decide."""
        return not state["done"] and len(state["choices"]) > 1

    def best(self, state):
        """The actions that are worth as much as any."""
        worth = lambda choice: choice["cost"] + sum(share * self.states[after]["value"] for after, share in choice["after"])
        return {choice["label"] for choice in state["choices"] if worth(choice) == state["value"]}

    def reached(self, decide):
        """The numbers of the states that are met when `decide` says what is done in a state with a choice."""
        met, open_ = {self.initial}, [self.initial]
        while open_:
            state = self.states[open_.pop()]
            if state["done"]:
                continue
            for after in {after for choice in taken(self, state, decide) for after, _ in choice["after"]}:
                if after not in met:
                    met.add(after)
                    open_.append(after)
        return met

    def table(self, name, states, allowed):
        rows = sorted((self.values(state), allowed(state)) for state in states)
        # What is the same in all rows tells nothing apart.
        asked = [i for i in range(len(self.inputs)) if len({values[i] for values, _ in rows}) > 1]
        rows = [(tuple(values[i] for i in asked), allowed) for values, allowed in rows]
        return Policy(name, [self.inputs[i] for i in asked], rows, {name for name in self.truth if self.inputs.index(name) in asked}, model=self)


def decided(folder, name):
    """Storm's scheduler, in all states with a choice."""
    model = Model(folder, name)
    policy = model.table(f"{name}, Storm's", [state for state in model.states if model.asks(state)], lambda state: {state["chosen"]})
    policy.read = (model, {json.dumps(state["values"]) for state in model.states if model.asks(state)})
    return policy


def met(folder, name):
    """Storm's scheduler, in the states that it meets."""
    model = Model(folder, name)
    reached = model.reached(lambda state: state["chosen"])
    states = [state for number, state in enumerate(model.states) if number in reached and model.asks(state)]
    policy = model.table(f"{name}, Storm's, reached", states, lambda state: {state["chosen"]})
    policy.read = (model, {json.dumps(state["values"]) for state in states})
    return policy


def optimal(folder, name):
    """All actions that are worth as much as any, in all states with a choice."""
    model = Model(folder, name)
    return model.table(f"{name}, any optimal", [state for state in model.states if model.asks(state)], model.best)


POLICIES = {
    "cruise": lambda _: cruise(),
    "pendulum": lambda _: pendulum(),
    "rooms": lambda _: rooms(),
    "maze": lambda _: maze(),
    "robot": lambda _: robot(),
    "planted": lambda _: planted(),
}
for each in MODELS:
    if each == "fetch":
        # Of the others the scheduler meets nearly all states, or nothing can be told from it.
        POLICIES[f"{each}-all"] = lambda folder, name=each: decided(folder, name)
    POLICIES[f"{each}-reached"] = lambda folder, name=each: met(folder, name)
    POLICIES[f"{each}-optimal"] = lambda folder, name=each: optimal(folder, name)


# --- Trees ----------------------------------------------------------------------------------------------------------------


class Wrong(Exception):
    """A tree that does not do what the policy says."""


def check(policy, decide):
    """Holds a tree against every row: what it may do there, all of it, has to be allowed. The mean of what it asks."""
    asked = 0
    for values, allowed in policy.rows:
        held = dict(zip(policy.inputs, values))
        actions, questions = decide(held)
        if not actions or not set(actions) <= allowed:
            raise Wrong(f"{policy.name}: at {held} the tree does {actions}, allowed is {allowed}")
        asked += questions
    return asked / len(policy.rows)


def run(command, folder, limit=LIMIT):
    """Runs a command: its seconds of wall time, what it printed, and whether it ended by itself in time and well."""
    began = time.monotonic()
    process = subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True)
    try:
        text, _ = process.communicate(timeout=limit)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        text, _ = process.communicate()
        return limit, text, False
    return time.monotonic() - began, text, process.returncode == 0


# btc: the tree as JSON, the comparisons from the program around it.


def btc(binary, policy, folder, source, effort=None):
    tree = folder / "btc.bt"
    more = ["--effort", str(effort)] if effort else []
    seconds, text, good = run([binary, "decanonicalize", source, "-o", tree, *more], folder, 10 * LIMIT)
    if not good:
        raise Wrong(f"{policy.name}: btc says {text}")
    size = subprocess.run([binary, "size", tree], check=True, capture_output=True, text=True).stdout
    printed = subprocess.run([binary, "compile", tree, "--emit", "json", "--tree", "learned"], check=True, capture_output=True, text=True).stdout
    root = json.loads(printed)["root"]
    names = comparisons(tree.read_text())
    back = actions_of_btc(policy)

    def holds(guard, held):
        if isinstance(guard, bool):
            return guard, 0
        if isinstance(guard, str):
            return names.get(guard.strip("`"), lambda held: held[guard.strip("`")] == 1)(held), 1
        if "not" in guard:
            value, asked = holds(guard["not"], held)
            return not value, asked
        stop = "or" in guard
        asked = 0
        for part in guard["or" if stop else "and"]:
            value, more = holds(part, held)
            asked += more
            if value == stop:
                return stop, asked
        return not stop, asked

    def tick(node, held):
        if node["node"] == "behavior":
            return node["behavior"].strip("`"), 0
        if node["node"] == "condition":
            return holds(node["condition"], held)
        assert node["node"] in ("selector", "sequence") and not node["memory"], node
        asked = 0
        for child in node["children"]:
            value, more = tick(child, held)
            asked += more
            if isinstance(value, str) or value == (node["node"] == "selector"):
                return value, asked
        return node["node"] == "sequence", asked

    def decide(held):
        # In dtControl's format inputs have no names.
        action, asked = tick(root, {**held, **{f"x_{i}": value for i, value in enumerate(held.values())}})
        return [back[action]] if isinstance(action, str) else [], asked

    asked = check(policy, decide)
    verdict, text, good = run([binary, "verify", tree, "learned", source], folder)
    if not good:
        raise Wrong(f"{policy.name}: btc verify says {text}")
    return {"tests": literals(root), "nodes": nodes_of(size), "seconds": seconds, "asked": asked}


def nodes_of(size):
    """The nodes of `learned` from what `btc size` prints."""
    lines = [line.split() for line in size.splitlines()]
    header = next(line for line in lines if "nodes" in line)
    row = next(line for line in lines if line and line[0] == "learned")
    return int(row[header.index("nodes") + (len(row) - len(header) if header[0] == "nodes" else 0)])


def literals(part):
    """The occurrences of predicates in the guards of a tree."""
    if isinstance(part, bool):
        return 0
    if isinstance(part, str):
        return 1
    if "node" not in part:
        below = [part["not"]] if "not" in part else part.get("and", part.get("or"))
        return sum(map(literals, below))
    if part["node"] == "condition":
        return literals(part["condition"])
    return sum(map(literals, part.get("children", [])))


def comparisons(text):
    """The predicates of a program that compare an input."""
    found = {}
    for name, number, operator, value in re.findall(r"(?m)^predicate (\S+)\s*= (\S+) (<=|==) (\S+)$", text):
        name, number = name.strip("`"), number.strip("`")
        assert operator == "<=", (name, operator)
        found[name] = lambda held, number=number, value=Fraction(value): exactly(held[number]) <= value
    return found


def exactly(number):
    return Fraction(shown(number))


def actions_of_btc(policy):
    """What btc calls the actions of a table."""
    actions = policy.actions()
    if not isinstance(actions[0], tuple):
        return {action: action for action in actions}
    called = lambda action: shown(action[0]) if len(action) == 1 else f"({', '.join(map(shown, action))})"
    return {f"u = {called(action)}": action for action in actions}


# dtControl: the tree as JSON.


def dtcontrol(python, policy, folder, preset):
    """What a preset makes of a policy, or why nothing."""
    out = folder / preset
    out.mkdir(exist_ok=True)
    command = [python, "-W", "ignore", "-c", "from dtcontrol.cli import main; main()"]
    command += ["--input", folder / "policy.csv", "--use-preset", preset, "--output", out, "-b", out / "figures", "--rerun", "--timeout", f"{LIMIT}s"]
    seconds, text, good = run(command, out, LIMIT + 30)
    trees = list(out.glob("**/policy/*.json"))
    if not good or not trees:
        reason = next((word for word in ("Not applicable", "Timed out", "Failed to fit") if word in text), None)
        return {"preset": preset, "failed": (reason or (text.strip().splitlines() or ["no result"])[-1]).lower()}
    figures = json.loads((out / "figures.json").read_text())["policy"]["classifiers"][preset]
    if not isinstance(figures, dict) or "accuracy" in figures:
        return {"preset": preset, "failed": f"accuracy {figures['accuracy']:.4f}" if isinstance(figures, dict) else figures}
    root = json.loads(trees[0].read_text())
    numbers = {tuple(float(f"{float(n):.6f}") for n in said): action for action, said in policy.numbers().items()}
    # The columns of its format have no names.
    place = {f"x_{i}": name for i, name in enumerate(policy.inputs)}

    def decide(held):
        node, asked = root, 0
        while node["split"]:
            asked += 1
            split = node["split"]
            terms = split["lhs"] if isinstance(split["lhs"], list) else [split["lhs"]]
            total = sum(term["intercept"] if "intercept" in term else term["coeff"] * float(held[place[term["var"]]]) for term in terms)
            node = node["children"][0 if total <= split["rhs"] else 1]
        said = node["actual_label"]
        return [numbers[tuple(map(float, re.findall(r"[-+.\de]+", action)))] for action in said], asked

    def sizes(node):
        """The nodes of a tree, and those of them that ask."""
        below = [sizes(child) for child in node["children"]]
        return 1 + sum(nodes for nodes, _ in below), bool(below) + sum(inner for _, inner in below)

    try:
        asked = check(policy, decide)
    except Wrong as wrong:
        return {"preset": preset, "failed": str(wrong)}
    nodes, inner = sizes(root)
    assert nodes == figures["stats"]["nodes"] and inner == figures["stats"]["inner nodes"], figures
    return {"preset": preset, "tests": inner, "nodes": nodes, "seconds": seconds, "search": seconds_of(figures["time"]), "asked": asked}


def seconds_of(text):
    """The seconds that dtControl means."""
    parts = [float(part) for part in re.findall(r"[\d.]+", text)]
    return sum(part * 60**place for place, part in enumerate(reversed(parts)))


# PAYNT: the tree as text.


def paynt(python, policy, folder, exact):
    """The tree of least depth that maps Storm's scheduler (`exact`), or that is worth as much as any, within the limit."""
    model = policy.model
    command = [python, "-m", "paynt", model.project, "--tree-depth", str(DEPTH), "--timeout", str(LIMIT)]
    command = [python, __file__, "--map", model.project] if exact else [*command, "--tree-enumeration"]
    seconds, text, good = run(command, folder, LIMIT + 30)
    (folder / "paynt.txt").write_text(text)
    found = re.search(r"printing the synthesized tree below:\n((?: *(?:if .*:|else:|\S+)\n)+)", text)
    if not found:
        return {"failed": f"none in {LIMIT} s" if seconds >= LIMIT - 1 else f"none of depth {DEPTH} or less" if good else "ended in an error"}
    root = read_tree(found.group(1).splitlines())
    decide = lambda held: walk(root, held)
    figures = {"tests": inner_nodes(root), "depth": depth_of(root), "seconds": seconds}
    said = re.search(r"synthesis finished after ([\d.]+) seconds", text)
    figures["search"] = float(said.group(1)) if said else seconds
    figures["nodes"] = 2 * figures["tests"] + 1
    # Where the search has not ended, a tree of this depth may be all there was time for.
    figures["cut"] = seconds >= LIMIT - 1
    everything = lambda state: {name: int(value) for name, value in state["values"].items()}
    reached = model.reached(lambda state: decide(everything(state))[0][0])
    rows = [state for number, state in enumerate(model.states) if number in reached and model.asks(state)]
    wrong = [state for state in rows if decide(everything(state))[0][0] not in model.best(state)]
    if exact:
        figures["asked"] = check(policy, decide)
    else:
        figures["asked"] = sum(decide(everything(state))[1] for state in rows) / len(rows)
        figures["reached"] = len(rows)
        figures["wrong"] = len(wrong)
        figures["loss"] = float(worth(model, lambda state: decide(everything(state))[0][0], reached) / model.states[model.initial]["value"] - 1)
    return figures


def taken(model, state, decide):
    """The choices that are taken in a state, each as often: all of them where PAYNT's `__random__` is, or an action that is none there."""
    choices = state["choices"]
    action = decide(state) if model.asks(state) else choices[0]["label"]
    return [choice for choice in choices if choice["label"] == action] or choices


def worth(model, decide, reached):
    """The costs that are to be expected of a policy, by iteration."""
    moves = {}
    for number in reached:
        state = model.states[number]
        if not state["done"]:
            choices = taken(model, state, decide)
            cost = sum(float(choice["cost"]) for choice in choices) / len(choices)
            moves[number] = (cost, [(after, float(share) / len(choices)) for choice in choices for after, share in choice["after"]])
    value = dict.fromkeys(reached, 0.0)
    for _ in range(200_000):
        change = 0.0
        for number, (cost, after) in moves.items():
            stay = sum(share for to, share in after if to == number)
            new = (cost + sum(share * value[to] for to, share in after if to != number)) / (1 - stay) if stay < 1 else float("inf")
            change = max(change, abs(new - value[number])) if new != float("inf") else change
            value[number] = new
        if change < 1e-11:
            break
    return value[model.initial]


def read_tree(lines):
    line = lines.pop(0).strip()
    if not line.startswith("if "):
        return line
    question = re.fullmatch(r"if (!?)\(?(\w+)\)?(?:(<=|>)(-?\d+))?:", line)
    negated, name, operator, bound = question.groups()
    then = read_tree(lines)
    assert lines.pop(0).strip() == "else:"
    return (name, operator, int(bound or 0), bool(negated)), then, read_tree(lines)


def walk(node, held):
    asked = 0
    while not isinstance(node, str):
        (name, operator, bound, negated), then, other = node
        value = held[name] <= bound if operator == "<=" else held[name] > bound if operator else held[name] == 1
        node = then if value != negated else other
        asked += 1
    return [node], asked


def inner_nodes(node):
    return 0 if isinstance(node, str) else 1 + inner_nodes(node[1]) + inner_nodes(node[2])


def depth_of(node):
    return 0 if isinstance(node, str) else 1 + max(depth_of(node[1]), depth_of(node[2]))


# --- The tables -----------------------------------------------------------------------------------------------------------


def measure(binary, root, name):
    policy = POLICIES[name](root)
    folder = root / "runs" / name
    folder.mkdir(parents=True, exist_ok=True)
    policy.write_dtcontrol(folder / "policy.csv")
    source = folder / "policy.csv"
    if policy.read:
        model, wanted = policy.read
        scheduler = json.loads((model.project / "scheduler.json").read_text())
        source = folder / "policy.json"
        source.write_text(json.dumps([entry for entry in scheduler if json.dumps(entry["s"]) in wanted], indent=1))
    elif not isinstance(policy.actions()[0], tuple):
        source = folder / "table.csv"
        policy.write_csv(source)
    several = sum(len(allowed) > 1 for _, allowed in policy.rows)
    figures = {"policy": policy.name, "rows": len(policy.rows), "inputs": len(policy.inputs), "several": several}

    def once(key, measured):
        """What was measured before is read again."""
        known = folder / f"{key}.figures.json"
        if not known.exists():
            known.write_text(json.dumps(measured()))
            print(name, key, known.read_text(), file=sys.stderr, flush=True)
        return json.loads(known.read_text())

    if binary:
        figures["btc"] = once("btc", lambda: btc(binary, policy, folder, source))
        figures["btc more"] = once("btc-more", lambda: btc(binary, policy, folder, source, EFFORT))
    for kind, presets in (("axis", AXIS), ("linear", LINEAR)):
        python = root / "dtcontrol/bin/python"
        figures[kind] = [once(preset, lambda: dtcontrol(python, policy, folder, preset)) for preset in presets]
    if policy.model and not name.endswith("-all"):
        figures["paynt"] = once("paynt", lambda: paynt(root / "paynt/bin/python", policy, folder, name.endswith("-reached")))
    return figures


def best(runs):
    good = [run for run in runs if "failed" not in run]
    return min(good, key=lambda run: (run["tests"], run["nodes"], run["seconds"])) if good else None


def cell(run, extra=""):
    return f"{run['tests']} / {run['nodes']}{extra}"


def seconds(run):
    return f"{run['seconds']:.1f}" + (f" ({run['search']:.1f})" if "search" in run else "")


def tables(all_figures):
    columns = ["policy", "rows", "inputs", "btc", "s", f"btc, `--effort {EFFORT}`", "s", "dtControl", "s", "dtControl, sums", "s", "PAYNT", "s"]
    yield "| " + " | ".join(columns) + " |"
    yield "| --- |" + " ---: |" * (len(columns) - 1)
    for figures in all_figures:
        row = [figures["policy"], str(figures["rows"]), str(figures["inputs"])]
        for key in ("btc", "btc more"):
            row += [cell(figures[key]), f"{figures[key]['seconds']:.1f}"]
        for kind in ("axis", "linear"):
            run = best(figures[kind])
            row += [cell(run, f" {run['preset']}"), seconds(run)] if run else ["none", ""]
        run = figures.get("paynt")
        if not run:
            row += ["", ""]
        elif "failed" in run:
            row += [run["failed"], ""]
        else:
            row += [cell(run, f", depth {run['depth']}" + (", stopped" if run.get("cut") else "")), seconds(run)]
        yield "| " + " | ".join(row) + " |"
    yield ""
    columns = ["policy", "rows with several actions", "asked per row: btc", f"btc, `--effort {EFFORT}`", "dtControl", "dtControl, sums", "PAYNT", "PAYNT: states reached", "costs above the least"]
    yield "| " + " | ".join(columns) + " |"
    yield "| --- |" + " ---: |" * (len(columns) - 1)
    for figures in all_figures:
        runs = [figures["btc"], figures["btc more"], best(figures["axis"]), best(figures["linear"]), figures.get("paynt")]
        row = [figures["policy"], str(figures["several"])] + [f"{run['asked']:.1f}" if run and "asked" in run else "" for run in runs]
        run = figures.get("paynt", {})
        row += [str(run.get("reached", "")), f"{100 * abs(run['loss']):.1f} %" if "loss" in run else ""]
        yield "| " + " | ".join(row) + " |"


def main():
    if sys.argv[1] in ("--storm", "--map"):
        {"--storm": storm, "--map": mapped}[sys.argv[1]](Path(sys.argv[2]))
        return
    binary, root, names = sys.argv[1], Path(sys.argv[2]).resolve(), sys.argv[3:]
    binary = str(Path(binary).resolve()) if binary != "-" else None
    all_figures = [measure(binary, root, name) for name in names or POLICIES]
    if binary:
        print("\n".join(tables(all_figures)))


if __name__ == "__main__":
    main()
