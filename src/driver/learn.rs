//! `btc learn`: from a checked program to a learned, proved, printed tree.

use super::load::Loaded;
use super::{run, target};
use crate::diagnostic::{Code, Diagnostic};
use crate::emit;
use crate::ir::task::Learner;
use crate::ir::tree::Node;
use crate::ir::{Id, Program};
use crate::learn::curve::{self, Point};
use crate::learn::episode::{Greedy, play_all};
use crate::learn::extract;
use crate::learn::process::Key;
use crate::learn::q_learning::{self, Counts, Settings};
use crate::learn::rollout::{RollOut, roll_out};
use crate::learn::schedule::Schedule;
use crate::learn::simulated::{Purpose, Simulated};
use crate::learn::statistics::{Summary, upper95};
use crate::learn::table::Table;
use crate::policy::{Policy, decisions, evidence, transitions};
use crate::tree::decanonicalise::{self, Care, Decanonicalised, Method};
use crate::world::{End, Simulator, Start};
use rustc_hash::FxHashMap;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

/// What a user may say beside the program.
#[derive(Clone, Copy, Debug)]
pub struct Options<'o> {
    /// Which learner, if there are several.
    pub learner: Option<&'o str>,
    /// In the place of the learner's own.
    pub seed: Option<u64>,
    /// In the place of the learner's own.
    pub episodes: Option<u64>,
    /// How the tree is found.
    pub method: Method,
    /// How many greedy episodes show the transitions of the policy.
    pub roll_outs: u64,
    /// The path of the source from the folder of the results.
    pub source: &'o str,
}

/// How far the learning has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Learning: this many of so many episodes are done.
    Learning(u64, u64),
    /// Rolling the greedy policy out.
    RollingOut,
    /// Turning it into a tree, and proving.
    Proving,
}

/// What was learned.
#[derive(Clone, Debug)]
pub struct Learned {
    /// The tree as an item of the language.
    pub tree: String,
    /// The files to write, by name.
    pub files: Vec<(&'static str, String)>,
    /// What a person wants to know, in lines.
    pub report: Vec<String>,
    /// The tree.
    pub root: Node,
    /// The policy.
    pub policy: Policy,
    /// The learner.
    pub learner: Id<Learner>,
}

/// Learns, decanonicalises, proves.
///
/// # Errors
/// There is no learner, the world cannot be built, nothing was learned, or the tree was refuted.
pub fn learn(
    loaded: &Loaded,
    options: &Options,
    progress: &(dyn Fn(Stage) + Sync),
) -> Result<Learned, Diagnostic> {
    let program = &loaded.program;
    let learner_id = target::learner(loaded, options.learner)?;
    let learner = &program.learners[learner_id];
    let task = &program.tasks[learner.task];
    let seed = options.seed.unwrap_or(learner.seed);
    let simulator = run::build(loaded, learner.task, &[&learner.start, &task.start], &[])?;
    let bench = Bench {
        program,
        learner,
        simulator: &simulator,
        seed,
        episodes: options.episodes.unwrap_or(learner.episodes),
    };
    let (table, counts, points) = bench.learn(progress);
    progress(Stage::RollingOut);
    let choices = extract::greedy(&table, &task.choose);
    let (met, summary) = bench.roll_out(&choices, options.roll_outs);
    let atoms = program.atoms(learner.task);
    let policy = extract::policy(&table, &met, task, atoms);
    progress(Stage::Proving);
    let found = decanonicalise::decanonicalise(&policy, options.method, Care::Seen)
        .map_err(|refuted| refused(loaded, &refuted))?;
    Ok(bench.write(
        loaded,
        options,
        learner_id,
        Results {
            counts,
            points,
            summary,
            policy,
            found,
        },
    ))
}

/// Everything that learning came to.
struct Results {
    counts: Counts,
    points: Vec<Point>,
    summary: Summary,
    policy: Policy,
    found: Decanonicalised,
}

/// A learner in its world.
struct Bench<'a> {
    program: &'a Program,
    learner: &'a Learner,
    simulator: &'a Simulator,
    seed: u64,
    episodes: u64,
}

/// The learner's start lines, in the simulator's lists.
const EXPLORING: usize = 0;

/// The task's start lines.
const OWN: usize = 1;

impl Bench<'_> {
    fn start(&self, purpose: Purpose, lines: usize, limit: u64) -> Start {
        Start {
            seed: self.seed,
            stream: purpose as u64,
            episode: 0,
            lines,
            limit,
        }
    }

    fn process(&self, start: Start) -> Simulated<'_> {
        let task = &self.program.tasks[self.learner.task];
        Simulated::new(self.simulator.simulation(), task, start)
    }

    fn learn(&self, progress: &(dyn Fn(Stage) + Sync)) -> (Table, Counts, Vec<Point>) {
        let pool = &self.program.pool;
        let learner = self.learner;
        let task = &self.program.tasks[learner.task];
        let settings = Settings {
            choices: task.choose.len(),
            episodes: self.episodes,
            rate: Schedule::new(pool, learner.rate),
            explore: Schedule::new(pool, learner.explore),
            discount: learner.discount,
            tick: self.program.world.as_ref().map_or(0.1, |world| world.tick),
            initial: learner.initial,
            dwell: learner.dwell,
            seed: self.seed,
        };
        let start = self.start(Purpose::Learn, EXPLORING, learner.episode_ticks);
        let mut process = self.process(start);
        let mut points = Vec::new();
        let (table, counts) =
            q_learning::learn(&mut process, &settings, |episode, table, counts| {
                if curve::due(episode, self.episodes) {
                    points.push(self.point(table, counts));
                }
                progress(Stage::Learning(episode + 1, self.episodes));
                true
            });
        (table, counts, points)
    }

    /// A point of the curve, measured on episodes of its own.
    fn point(&self, table: &Table, counts: &Counts) -> Point {
        let task = &self.program.tasks[self.learner.task];
        let choices = extract::greedy(table, &task.choose);
        let start = self.start(Purpose::Curve, OWN, task.end_after);
        let unseen = run::unseen(self.program, self.learner.task);
        let episodes = play_all(curve::EPISODES, start, task.patience, || {
            (self.simulator.simulation(), Greedy::new(&choices, unseen))
        });
        let ended = episodes.iter().filter(|episode| episode.end != End::Cut);
        let totals: Vec<f64> = episodes.iter().map(|episode| episode.total).collect();
        Point {
            episodes: counts.episodes,
            decisions: counts.decisions,
            ticks: counts.ticks,
            minterms: choices.len(),
            total: crate::learn::statistics::Mean::of(&totals),
            ended: ended.count() as u64,
        }
    }

    /// The greedy policy from the task's own starts: its transitions, and what it is worth.
    fn roll_out(
        &self,
        choices: &FxHashMap<Key, Id<crate::ir::law::Behavior>>,
        episodes: u64,
    ) -> (RollOut, Summary) {
        let task = &self.program.tasks[self.learner.task];
        let unseen = run::unseen(self.program, self.learner.task);
        let start = self.start(Purpose::RollOut, OWN, task.end_after);
        let number = |behavior| task.choose.iter().position(|&choice| choice == behavior);
        let choice = |key: Key| match choices.get(&key) {
            Some(&behavior) => (number(behavior).unwrap_or(0), true),
            None => (number(unseen).unwrap_or(0), false),
        };
        let met = roll_out(episodes, &choice, || self.process(start));
        let summary = Summary::of(&met.episodes, task.end_on.len());
        (met, summary)
    }

    fn write(
        &self,
        loaded: &Loaded,
        options: &Options,
        learner: Id<Learner>,
        results: Results,
    ) -> Learned {
        let Results {
            counts,
            points,
            summary,
            policy,
            found,
        } = results;
        let program = self.program;
        let task = &program.tasks[self.learner.task];
        let file = options.source.rsplit('/').next().unwrap_or_default();
        let proof = &found.proof;
        let closed = if proof.closed {
            ", closed under them"
        } else {
            ", not closed under them"
        };
        let docs = vec![format!(
            "Learned from {file}, seed {}: proved on {} observed minterms and {} transitions{closed}.",
            self.seed, proof.minterms, proof.transitions
        )];
        let name = &self.learner.name;
        let tree = emit::bt::tree(program, name, &docs, Some(&task.name), &found.root);
        let program_text = format!(
            "//! Written by `btc learn`. The table is what the greedy policy met; proofs go along its paths.\n\
             use \"{}\"\nuse \"transitions.csv\"\n\n{tree}",
            options.source
        );
        let report = self.report(&counts, &summary, &policy, &found);
        let metrics = self.metrics(loaded, options, &counts, &summary, &policy, &found);
        let files = vec![
            ("learned.bt", program_text),
            ("learned.dot", emit::dot::tree(name, &found.root, program)),
            ("policy.csv", decisions::write(&policy, program)),
            ("transitions.csv", transitions::write(&policy, program)),
            ("q.csv", evidence::write(&policy, program)),
            ("curve.csv", curve::csv(&points)),
            ("metrics.json", pretty(&metrics)),
        ];
        Learned {
            tree,
            files,
            report,
            root: found.root,
            policy,
            learner,
        }
    }

    fn report(
        &self,
        counts: &Counts,
        summary: &Summary,
        policy: &Policy,
        found: &Decanonicalised,
    ) -> Vec<String> {
        let program = self.program;
        let task = &program.tasks[self.learner.task];
        let mut lines = vec![
            format!(
                "learned      {} minterms in {} decisions, {} ticks, {} episodes",
                policy.rows.len(),
                counts.decisions,
                counts.ticks,
                counts.episodes
            ),
            format!(
                "tree         {} nodes, {} literals, depth {} (Algorithm 1 alone: {} nodes)",
                found.size.nodes, found.size.literals, found.size.depth, found.paper_size.nodes
            ),
            format!(
                "proved       on {} minterms and {} transitions, {}",
                found.proof.minterms,
                found.proof.transitions,
                if found.proof.closed {
                    "closed under them"
                } else {
                    "which leave them"
                }
            ),
            format!(
                "return       {:.3}, 95 % [{:.3}, {:.3}], in {} greedy episodes",
                summary.total.mean, summary.total.ci95[0], summary.total.ci95[1], summary.episodes
            ),
        ];
        for (event, (_, rate)) in program.events.values().zip(&summary.events) {
            lines.push(format!("{:<12} {:.3} in 1000 ticks", event.name, rate.mean));
        }
        for (end, count) in run::end_names(program, task).iter().zip(&summary.ended) {
            let upper = 100.0 * upper95(*count, summary.episodes);
            lines.push(format!(
                "ended        {count} of {} by {end}, at most {upper:.2} % (95 %)",
                summary.episodes
            ));
        }
        if summary.outside > 0 {
            let upper = 100.0 * upper95(summary.outside, summary.ticks);
            lines.push(format!(
                "outside      {} of {} ticks in minterms never learned, at most {upper:.3} % (95 %)",
                summary.outside, summary.ticks
            ));
        }
        for failing in &found.failing {
            let then: Vec<String> = failing
                .then
                .iter()
                .map(|next| match next {
                    Some(id) => program.behaviors[*id].name.clone(),
                    None => "nothing".to_owned(),
                })
                .collect();
            lines.push(format!(
                "fails        {} failed outright {} times ({} with no change) in {}; the tree goes on to {}",
                program.behaviors[failing.behavior].name,
                failing.count,
                failing.repeated,
                minterm_text(program, policy, &failing.minterm),
                then.join(" or "),
            ));
        }
        lines
    }

    fn metrics(
        &self,
        loaded: &Loaded,
        options: &Options,
        counts: &Counts,
        summary: &Summary,
        policy: &Policy,
        found: &Decanonicalised,
    ) -> Value {
        let program = self.program;
        let task = &program.tasks[self.learner.task];
        let ran = run::Ran {
            summary: summary.clone(),
            events: program.events.values().map(|e| e.name.clone()).collect(),
            ends: run::end_names(program, task),
        };
        let size = |size: &crate::tree::Size| json!({ "nodes": size.nodes, "literals": size.literals, "depth": size.depth });
        json!({
            "btc": env!("CARGO_PKG_VERSION"),
            "source": options.source,
            "sha256": hashes(loaded),
            "task": task.name,
            "learner": self.learner.name,
            "seed": self.seed,
            "episodes": counts.episodes,
            "decisions": counts.decisions,
            "ticks": counts.ticks,
            "roll_outs": options.roll_outs,
            "method": match options.method {
                Method::Paper => "paper",
                Method::Search => "search",
            },
            "minterms": policy.rows.len(),
            "starts": policy.starts.len(),
            "transitions": policy.transitions.len(),
            "tree": size(&found.size),
            "paper_tree": size(&found.paper_size),
            "proof": {
                "minterms": found.proof.minterms,
                "transitions": found.proof.transitions,
                "closed": found.proof.closed,
            },
            "greedy": ran.json(),
            "outside": {
                "ticks": summary.outside,
                "upper95": upper95(summary.outside, summary.ticks.max(1)),
            },
            "failing": found.failing.iter().map(|failing| json!({
                "minterm": minterm_text(program, policy, &failing.minterm),
                "behavior": program.behaviors[failing.behavior].name,
                "count": failing.count,
                "repeated": failing.repeated,
            })).collect::<Vec<_>>(),
        })
    }
}

/// The atoms that hold in a minterm.
pub(super) fn minterm_text(
    program: &Program,
    policy: &Policy,
    minterm: &crate::policy::Minterm,
) -> String {
    let held: Vec<String> = policy
        .atoms
        .iter()
        .zip(minterm.values())
        .filter(|(_, holds)| *holds)
        .map(|(atom, _)| program.atom_name(*atom))
        .collect();
    if held.is_empty() {
        "{}".to_owned()
    } else {
        format!("{{{}}}", held.join(", "))
    }
}

/// The SHA-256 of every file of the program, by its name without folders.
fn hashes(loaded: &Loaded) -> Value {
    let files = loaded.files.iter().filter_map(|id| loaded.sources.get(*id));
    let hashes = files.map(|source| {
        let name = source
            .name
            .rsplit('/')
            .next()
            .unwrap_or_default()
            .to_owned();
        let digest = Sha256::digest(source.text.as_bytes());
        let hex: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
        (name, Value::String(hex))
    });
    Value::Object(hashes.collect())
}

fn pretty(value: &Value) -> String {
    let mut text = serde_json::to_string_pretty(value).unwrap_or_default();
    text.push('\n');
    text
}

/// Nothing is printed unproved.
fn refused(loaded: &Loaded, refuted: &crate::tree::prove::Refuted) -> Diagnostic {
    let at = target::end_of_file(loaded);
    match refuted {
        crate::tree::prove::Refuted::Empty => Diagnostic::new(
            Code::E0505,
            at,
            "nothing was learned: no decision was completed",
        )
        .help("let there be more episodes, or longer ones"),
        other => Diagnostic::new(
            Code::E0609,
            at,
            format!("the tree that was found is not equal to the policy: {other:?}"),
        )
        .note("this is a mistake of btc itself; please report it with the program"),
    }
}
