//! The files that `btc learn` writes.

use super::{Learned, Options, warnings};
use crate::driver::Refused;
use crate::driver::digest::sha256;
use crate::driver::export;
use crate::driver::load::Loaded;
use crate::driver::target;
use crate::emit::bt;
use crate::emit::form::TreeForm;
use crate::ir::task::Learner;
use crate::ir::tree::{Node, Tree};
use crate::ir::{Id, Name};
use crate::policy::{decisions, evidence, transitions};
use crate::report::results::Results;
use crate::report::{self, curve, grown, metrics};

/// The tree as an item, the files, and the report.
///
/// # Errors
/// A robot's library has no counterpart for a node of the tree.
pub(super) fn written(
    loaded: &Loaded,
    options: &Options,
    id: Id<Learner>,
    results: Results,
) -> Result<Learned, Refused> {
    let program = &loaded.program;
    let experiment = results.experiment;
    let (learner, task) = (experiment.learner, experiment.task);
    let file = options.source.rsplit('/').next().unwrap_or_default();
    let exact = &results.trees.chosen().root;
    let named = |name: &Name, docs: &[String], root: &Node| Tree {
        name: name.clone(),
        docs: docs.to_vec(),
        task: Some(learner.task),
        root: root.clone(),
    };
    let table = transitions::write(&results.policy, program);
    let mut text = format!(
        "//! Written by `btc learn`. The table is what the greedy policy met; proofs go along its paths.\n\
         use \"{}\"\nuse \"transitions.csv\" sha256:{}\n\n",
        options.source,
        sha256(table.as_bytes())
    );
    let mut docs = vec![results.origin(file)];
    let mut root = exact;
    if let Some(grown) = results.grown.as_ref().filter(|grown| !grown.kept) {
        let exact_name = Name::word(format!("{}_exact", learner.name.family));
        let exact = named(&exact_name, &docs, exact);
        text.push_str(&bt::tree(program, &exact));
        text.push('\n');
        docs.push(grown::doc(grown, program, task));
        root = &grown.root;
    }
    let learned = named(&learner.name, &docs, root);
    let item = bt::tree(program, &learned);
    text.push_str(&item);
    let curves = results.curves();
    let warnings = warnings::warnings(loaded, &results);
    let policy = &results.policy;
    let exported = export::named_after(file, &learned);
    let written = |form: TreeForm| {
        let place = |_: &[usize]| target::end_of_file(loaded);
        let tree = match form.is_for_robots() {
            true => &exported,
            false => &learned,
        };
        export::tree(program, tree, form, place)
            .map_err(|mistake| Refused::program(loaded, [mistake]))
    };
    let told: Vec<(String, String)> = warnings
        .iter()
        .map(|warning| (warning.code.name().to_owned(), warning.message.clone()))
        .collect();
    let request = metrics::Request {
        source: options.source,
        sha256: &hashes(loaded),
        warnings: &told,
        roll_outs: options.roll_outs,
        method: options.method,
        care: options.care,
    };
    let mut files = vec![
        ("learned.bt", text),
        ("learned.dot", written(TreeForm::Dot)?),
        ("learned.svg", written(TreeForm::Svg)?),
        ("learned.xml", written(TreeForm::BtCpp)?),
        ("learned.py", written(TreeForm::PyTrees)?),
        ("policy.csv", decisions::write(policy, program)),
        ("transitions.csv", table),
        ("q.csv", evidence::write(policy, program)),
        ("curve.csv", curve::csv(&curves)),
        (
            "curve.svg",
            curve::picture(&learner.name.to_string(), &curves),
        ),
        ("metrics.json", metrics::json(&results, &request)),
    ];
    let mut report = report::learned::lines(&results);
    let mut headline = report::headline::lines(&results);
    if let Some(grown) = &results.grown {
        let name = format!(
            "{}, seed {}",
            learner.name,
            results.run().map_or(0, |run| run.seed)
        );
        files.push(("front.svg", grown::picture(grown, &name)));
        if options.front {
            let front = grown::front(grown);
            headline.extend(front.iter().cloned());
            report.extend(front);
        }
    }
    Ok(Learned {
        text: item,
        files,
        headline,
        report,
        warnings,
        tree: learned,
        learner: id,
        curves,
        policy: results.policy,
    })
}

/// The SHA-256 of every file of the program, by its name without folders.
fn hashes(loaded: &Loaded) -> Vec<(String, String)> {
    let files = loaded.files.iter().filter_map(|id| loaded.sources.get(*id));
    let hashes = files.map(|source| {
        let name = source.name.rsplit('/').next().unwrap_or_default();
        (name.to_owned(), sha256(source.text.as_bytes()))
    });
    hashes.collect()
}
