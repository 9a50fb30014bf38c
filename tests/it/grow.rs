//! Trees that grow: the moves, and the search that simulation judges.

use crate::program::NoFiles;
use btc::checkpoint::Forgetful;
use btc::driver::load::{self, Loaded};
use btc::driver::target;
use btc::emit;
use btc::grow::place::{Place, paths};
use btc::grow::{self, Choice, Grown, Settings, Starts};
use btc::ir::Id;
use btc::ir::task::Task;
use btc::ir::tree::{Guard, Node, Tree};
use btc::learn::experiment::Experiment;
use btc::learn::simulated::Purpose;
use btc::report;
use btc::tree::Size;
use btc::tree::prune::{Change, Cost, candidates, negated_literals, plainer, tidy};

/// Small delivery in short episodes, with a tree `given`.
fn small(tree: &str) -> (Loaded, Id<Task>, Node) {
    let text = include_str!("../../examples/delivery_small.bt")
        .replace("end after 5_000 ticks", "end after 400 ticks");
    assert!(text.contains("400 ticks"));
    let text = format!("{text}\ntree given for delivery = {tree}\n");
    let loaded = load::load("small.bt", text.into_bytes(), &mut NoFiles);
    assert!(!loaded.has_errors(), "{:?}", loaded.diagnostics);
    let tree = target::tree(&loaded, "given").unwrap();
    let task = target::task_of(&loaded, Some(tree)).unwrap();
    let root = loaded.program.trees[tree].root.clone();
    (loaded, task, root)
}

/// What grows from a tree, with little effort, in a world that has no other tree.
fn grown(tree: &str, choice: Choice) -> (Loaded, Grown) {
    shown(tree, choice, choice != Choice::Knee)
}

/// The same, with the front or without.
fn shown(tree: &str, choice: Choice, front: bool) -> (Loaded, Grown) {
    let (loaded, _, exact) = small(tree);
    let experiment = Experiment::new(&loaded.program, Id::new(0), None, 10).unwrap();
    let ground = grow::ground(&experiment, 1);
    let starts = Starts {
        minterms: Vec::new(),
        exact,
        others: Vec::new(),
        found: Vec::new(),
    };
    let settings = Settings {
        effort: 2_000_000,
        requirements: &[],
        choice,
        front,
    };
    let found = grow::grow(&ground, &starts, &settings, &Forgetful, &|_| {}).unwrap();
    (loaded, found)
}

/// Figure 8 with literals that say nothing, without its memory, and with a unit that is never reached.
const CLUMSY: &str = "selector {
    battery_low and done(goto(C)) => dock(C),
    battery_low and not done(goto(C)) and not done(dock(C)) or battery_low and done(goto(A)) => goto(C),
    battery_low => goto(C),
    carrying_package and battery_low => goto(A),
    carrying_package and not battery_low => goto(B),
    not carrying_package or not battery_low and done(dock(C)) => goto(A),
}";

/// What a person would write.
const EXPERT: &str = "selector {
    battery_low => memory sequence { goto(C), dock(C) },
    carrying_package => goto(B),
    goto(A),
}";

fn printed(loaded: &Loaded, root: &Node) -> String {
    emit::bt::tree(&loaded.program, &Tree::plain("given".into(), root.clone()))
}

/// No composite of one child, no constant and no nesting that the printer would have to show.
fn assert_tidy(node: &Node) {
    assert_eq!(&tidy(node.clone()), node);
    if let Node::Composite { children, .. } = node {
        assert!(children.len() > 1, "{node:?}");
    }
    assert!(
        !matches!(node, Node::Condition(Guard::Const(_))),
        "{node:?}"
    );
    node.children().iter().for_each(assert_tidy);
}

/// Whoever looks at the front gets the tree that they get without it, and trees that have all played alike long.
#[test]
fn a_front_that_is_shown_changes_no_choice() {
    let [without, with] = [false, true].map(|front| shown(CLUMSY, Choice::Knee, front).1);
    let alone = Grown {
        front: without.front.clone(),
        ticks: without.ticks,
        ..with.clone()
    };
    assert_eq!(alone, without);
    let taken: Vec<_> = with.front.iter().filter(|point| point.taken).collect();
    assert_eq!(taken.len(), 1);
    assert_eq!(taken[0].root, with.root);
    let sizes: Vec<usize> = with.front.iter().map(|point| point.size.nodes).collect();
    assert!(sizes.len() > 1 && sizes.is_sorted(), "{sizes:?}");
    let mut played = with.front.iter().map(|point| point.episodes);
    let first = played.next();
    assert!(played.all(|episodes| Some(episodes) == first));
}

/// A tree of the file that gives other numbers is a start, with what the task chooses among; any other one is none.
#[test]
fn a_tree_with_other_numbers_is_fitted() {
    let fitted = |tree: &str| {
        let (loaded, task, _) = small(tree);
        let program = &loaded.program;
        let given = target::tree(&loaded, "given").unwrap();
        let (root, stand_ins) = program.tasks[task].fitted(program, &program.trees[given])?;
        Some((printed(&loaded, &root), stand_ins.len()))
    };
    let (expert, none) = fitted(EXPERT).unwrap();
    assert_eq!(none, 0);
    let other = EXPERT.replace("goto(C)", "goto(C, margin = 30 cm)");
    assert_eq!(fitted(&other).unwrap(), (expert, 1));
    let asked = |behavior: &str| format!("selector {{ done({behavior}) => {behavior}, goto(A) }}");
    let (text, _) = fitted(&asked("goto(B, margin = 30 cm)")).unwrap();
    assert!(text.contains("done(goto(B)) => goto(B)"), "{text}");
    assert_eq!(fitted(&EXPERT.replace("goto(B)", "wait(1 s)")), None);
}

#[test]
fn every_candidate_is_smaller_tidy_and_new() {
    let (.., mut root) = small(CLUMSY);
    // Down in small steps, to see trees that moves have made.
    for _ in 0..6 {
        let found = candidates(&root, &[]);
        assert_eq!(found, candidates(&root, &[]));
        for (i, candidate) in found.iter().enumerate() {
            assert!(candidate.size < Size::of(&root));
            assert_eq!(candidate.size, Size::of(&candidate.root));
            assert_tidy(&candidate.root);
            let twin = found.iter().take(i).find(|c| c.root == candidate.root);
            assert_eq!(twin, None);
        }
        let next = found.into_iter().max_by_key(|candidate| candidate.size);
        root = next.unwrap().root;
    }
}

#[test]
fn candidates_read_as_the_language_has_them() {
    let (loaded, _, root) = small(CLUMSY);
    for candidate in candidates(&root, &[]) {
        let text = printed(&loaded, &candidate.root);
        let (.., again) = small(text.split_once('=').unwrap().1);
        assert_eq!(Size::of(&again), candidate.size, "{text}");
    }
}

#[test]
fn plainer_trees_are_no_larger() {
    let (_, _, root) = small("selector { not carrying_package => goto(A), goto(B) }");
    let found = plainer(&root, &[]);
    let (.., wanted) = small("selector { carrying_package => goto(B), goto(A) }");
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].root, wanted);
    assert_eq!(negated_literals(&root), 1);
    assert_eq!(negated_literals(&wanted), 0);
}

#[test]
fn a_unit_that_does_not_ask_for_what_it_needs_costs_a_node() {
    let (loaded, task, root) = small(EXPERT);
    let (goto_b, low) = (
        loaded.program.tasks[task].choose[1],
        loaded.program.atoms(task)[1],
    );
    let size = Size::of(&root);
    assert_eq!(Cost::of(&root, &[]).nodes, size.nodes);
    let possible = [(goto_b, low)];
    let cost = Cost::of(&root, &possible);
    assert_eq!((cost.nodes, cost.unasked), (size.nodes + 1, 1));
    // To ask costs no more than not to ask, and is preferred.
    let asked = candidates(&root, &possible);
    let asked = asked.iter().filter(|c| c.change == Change::Required);
    assert!(
        asked
            .clone()
            .any(|c| c.size.nodes == size.nodes + 1 && c.cost.unasked == 0)
    );
}

#[test]
fn a_clumsy_tree_becomes_small() {
    let (loaded, found) = grown(CLUMSY, Choice::Knee);
    let text = printed(&loaded, &found.root);
    assert!(!found.kept, "{text}");
    assert!(found.after.size.nodes <= 10, "{text}");
    assert!(found.gain.ci95[1] >= 0.0, "{:?}", found.gain);
    assert_eq!(found.after.harms, 0);
    assert_eq!(found.before.size, Size::of(&small(CLUMSY).2));
    let doc = report::grown::doc(&found, &loaded.program, &loaded.program.tasks[Id::new(0)]);
    assert!(doc.contains("tested, not proved"), "{doc}");
    assert!(doc.contains("ended by dead"), "{doc}");
}

#[test]
fn a_good_tree_is_not_made_worse() {
    let (_, found) = grown(EXPERT, Choice::Knee);
    assert_eq!(found.after.harms, 0);
    assert!(found.kept || found.gain.ci95[0] > 0.0, "{:?}", found.gain);
}

#[test]
fn a_number_of_nodes_is_kept_to() {
    let (_, found) = grown(CLUMSY, Choice::Nodes(9));
    assert!(found.after.size.nodes <= 9 || found.kept);
    let taken: Vec<_> = found.front.iter().filter(|point| point.taken).collect();
    assert_eq!(taken.len(), 1);
    assert_eq!(taken[0].root, found.root);
}

#[test]
fn the_front_rises() {
    let (_, found) = grown(CLUMSY, Choice::Loss(0.2));
    let best = |points: &[grow::Point]| {
        let pairs = points.windows(2);
        pairs.filter(|pair| !pair[1].taken).all(|pair| {
            pair[0].size.nodes <= pair[1].size.nodes && pair[0].returns.mean < pair[1].returns.mean
        })
    };
    assert!(best(&found.front), "{:?}", found.front);
}

#[test]
fn threads_do_not_matter() {
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().unwrap();
        pool.install(|| grown(CLUMSY, Choice::Knee).1)
    };
    assert_eq!(on(1), on(2));
}

/// A unit that is put somewhere stands there once, and nothing else changes but the selector around it.
#[test]
fn a_unit_is_put_in_every_place() {
    let (.., root) = small(EXPERT);
    let (.., unit) = small("carrying_package => dock(C)");
    let places = Place::all(&root);
    // Four among the units, one before each of three behaviours or memory nodes under a guard.
    assert_eq!(places.len(), 6);
    for place in places {
        let new = place.put(&root, &unit);
        assert_eq!(paths(&new, &|node| *node == unit).len(), 1, "{place:?}");
        let more = Size::of(&new).nodes - Size::of(&root).nodes;
        assert_eq!(more, Size::of(&unit).nodes + place.nodes(), "{place:?}");
    }
}

/// What a tree does in some of its episodes is what it does in them among all; and of what another tree does alike nothing is
/// simulated.
#[test]
fn sampled_episodes_are_those_that_are_played() {
    let (loaded, _, clumsy) = small(CLUMSY);
    let experiment = Experiment::new(&loaded.program, Id::new(0), None, 10).unwrap();
    let ground = grow::ground(&experiment, 1);
    let trials = ground.trials(Purpose::Grow, 3);
    let never_charges = Node::Behavior(ground.choices[0]);
    let [mut base, mut other] =
        [&clumsy, &never_charges].map(|root| trials.contender(root).unwrap());
    trials.play(&mut [&mut base, &mut other], 12, None);
    let fresh = [&never_charges, &clumsy].map(|root| trials.contender(root).unwrap());
    let episodes = [11, 1, 5];
    let (figures, simulated) = trials.sample(&[&fresh[0], &fresh[1]], &episodes, &base);
    for (found, played) in figures.iter().zip([&other, &base]) {
        let played = played.results();
        let played: Vec<String> = episodes.map(|n| format!("{:?}", played[n])).to_vec();
        let found: Vec<String> = found.iter().map(|it| format!("{it:?}")).collect();
        assert_eq!(found, played);
    }
    let ticks = |n: usize| other.results()[n].ticks;
    assert_eq!(
        simulated.ticks,
        episodes.into_iter().map(ticks).sum::<u64>()
    );
    assert!(fresh.iter().all(|contender| contender.episodes() == 0));
}
