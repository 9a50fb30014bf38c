//! The task, tree or learner that a command is about.

use super::load::Loaded;
use super::refused::Refused;
use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::ir::name::{self, Name};
use crate::ir::task::{Learner, Task};
use crate::ir::tree::Tree;
use crate::ir::{Id, Program};
use crate::source::Span;
use crate::syntax::ast::{
    self, ArgKind, AspectKind, Expr, ExprKind, Item, ItemKind, LearnEntry, Node, NodeKind,
    RobotEntryKind, Start, StartLine, WorldEntryKind,
};

/// The end of the main file: where something is missing.
pub fn end_of_file(loaded: &Loaded) -> Span {
    let file = loaded.ast.span.file;
    let text = loaded.sources.get(file).map_or("", |source| &source.text);
    let end = text.trim_end().len();
    Span::new(file, end, end)
}

/// The name of the world, or the end of the main file.
pub fn world_span(loaded: &Loaded) -> Span {
    let world = |item: &Item| match &item.kind {
        ItemKind::World(world) => Some(world.name.span),
        _ => None,
    };
    let found = loaded.asts().flat_map(|ast| &ast.items).find_map(world);
    found.unwrap_or_else(|| end_of_file(loaded))
}

/// The tree of that name as it is written; one of a file goes before one of the files that it uses.
pub fn written<'l>(loaded: &'l Loaded, name: &str) -> Option<&'l ast::Tree> {
    let named = |ast: &'l ast::File| {
        ast.items.iter().find_map(|item| match &item.kind {
            ItemKind::Tree(tree) if tree.name.name == name => Some(tree),
            _ => None,
        })
    };
    let used: Vec<&ast::File> = loaded.asts().skip(1).collect();
    let own = named(&loaded.ast);
    own.or_else(|| used.into_iter().rev().find_map(named))
}

/// The name of a tree where it is written, or the end of the main file.
pub fn tree_span(loaded: &Loaded, tree: &Tree) -> Span {
    let name = tree.name.as_word();
    let written = name.and_then(|name| written(loaded, name));
    written.map_or_else(|| end_of_file(loaded), |written| written.name.span)
}

/// The last item of that sort in the program, by its name, if it can be one of the main file; without one its last task, or
/// else the end of the main file.
pub fn place_of(loaded: &Loaded, word: &str) -> Span {
    let of = |word: &str, item: &Item| match (word, &item.kind) {
        ("tree", ItemKind::Tree(tree)) => Some(tree.name.span),
        ("learner" | "learn", ItemKind::Learn(learn)) => {
            Some(learn.name.as_ref().unwrap_or(&learn.task).span)
        }
        ("task", ItemKind::Task(task)) => Some(task.name.span),
        _ => None,
    };
    let last = |word: &str| {
        let in_file = |ast: &ast::File| {
            ast.items
                .iter()
                .filter_map(|item| of(word, item))
                .next_back()
        };
        let own = in_file(&loaded.ast);
        own.or_else(|| loaded.asts().filter_map(in_file).last())
    };
    let found = last(word).or_else(|| last("task"));
    found.unwrap_or_else(|| end_of_file(loaded))
}

/// Where the program says at which position a robot starts: another than the acting one by its name.
pub fn positions(loaded: &Loaded, robot: Option<&Name>) -> Vec<Span> {
    let acting = loaded.program.world.as_ref().map(|world| &world.robot.name);
    let is_own = |line: &&StartLine| match line.target.args.as_deref() {
        None => robot.is_none(),
        Some([arg]) => match &arg.kind {
            ArgKind::Positional(Expr {
                kind: ExprKind::Ref(named),
                ..
            }) => (robot.or(acting)).is_some_and(|robot| robot.is(&named.name.name)),
            _ => false,
        },
        Some(_) => false,
    };
    let mut found = Vec::new();
    let mut lines = |start: &Start| {
        let lines = start.lines.iter();
        let at = |line: &&StartLine| matches!(line.target.name.name.as_str(), "position" | "pose");
        let positions = lines.filter(at).filter(is_own);
        found.extend(positions.map(|line| line.value.span));
    };
    for item in loaded.asts().flat_map(|ast| &ast.items) {
        match &item.kind {
            ItemKind::Task(task) => {
                for aspect in &task.aspects {
                    if let AspectKind::Start(start) = &aspect.kind {
                        lines(start);
                    }
                }
            }
            ItemKind::Learn(learn) => {
                for entry in &learn.entries {
                    if let LearnEntry::Start(start) = entry {
                        lines(start);
                    }
                }
            }
            _ => {}
        }
    }
    found
}

/// The tree of that name.
///
/// # Errors
/// There is none: a diagnostic that offers the likely one.
pub fn tree(loaded: &Loaded, name: &str) -> Result<Id<Tree>, Refused> {
    let trees = &loaded.program.trees;
    trees
        .find(|tree| tree.name.is(name))
        .ok_or_else(|| missing(loaded, "tree", name, trees.values().map(|tree| &tree.name)))
}

/// What another robot runs under that name, as a tree for no task.
pub fn script(loaded: &Loaded, name: &str) -> Option<Tree> {
    let world = loaded.program.world.as_ref()?;
    let worlds = loaded.asts().flat_map(|ast| &ast.items);
    let worlds = worlds.filter_map(|item| match &item.kind {
        ItemKind::World(world) => Some(world),
        _ => None,
    });
    let robots = worlds.flat_map(|world| &world.entries);
    let mut runs = robots.filter_map(|entry| match &entry.kind {
        WorldEntryKind::Robot { name: robot, .. } => {
            run_by(&entry.kind).filter(|runs| *runs == name)?;
            let others = &world.others;
            others[others.find(|other| other.robot.name.is(&robot.name))?]
                .script
                .clone()
        }
        _ => None,
    });
    let root = runs.next()?;
    let place = written(loaded, name)?.name.span;
    let mut items = loaded.asts().flat_map(|ast| &ast.items);
    let written =
        items.find(|item| matches!(&item.kind, ItemKind::Tree(tree) if tree.name.span == place));
    let docs = written.map(|item| item.docs.clone());
    Some(Tree {
        name: Name::word(name),
        docs: docs.unwrap_or_default(),
        task: None,
        root,
    })
}

/// The only tree, or the only one that is neither a part of others nor the script of another robot.
///
/// # Errors
/// There is none, or there are several.
pub fn only_tree(loaded: &Loaded) -> Result<Id<Tree>, Refused> {
    let trees = &loaded.program.trees;
    let used = used_trees(loaded);
    let whole = |id: &Id<Tree>| !used.contains(&trees[*id].name.family.as_str());
    let mut wholes = trees.ids().filter(whole);
    if let (Some(only), None) = (wholes.next(), wholes.next()) {
        return Ok(only);
    }
    let names = trees.values().map(|tree| &tree.name);
    only(loaded, "tree", names, trees.ids())
}

/// What the trees of a program name as their leaves, and the trees that its other robots run.
pub fn used_trees(loaded: &Loaded) -> Vec<&str> {
    fn leaves<'a>(node: &'a Node, found: &mut Vec<&'a str>) {
        match &node.kind {
            NodeKind::Composite { children, .. } => {
                children.iter().for_each(|child| leaves(child, found));
            }
            NodeKind::Guarded { node, .. } => leaves(node, found),
            NodeKind::Leaf(expr) => found.extend(named(expr)),
            NodeKind::Error => {}
        }
    }
    let mut found = Vec::new();
    for item in loaded.asts().flat_map(|ast| &ast.items) {
        match &item.kind {
            ItemKind::Tree(tree) => leaves(&tree.root, &mut found),
            ItemKind::World(world) => {
                let entries = world.entries.iter();
                found.extend(entries.filter_map(|entry| run_by(&entry.kind)));
            }
            _ => {}
        }
    }
    found
}

/// The tree that a robot of a world runs, if it is another than the acting one.
fn run_by(entry: &WorldEntryKind) -> Option<&str> {
    let WorldEntryKind::Robot { entries, .. } = entry else {
        return None;
    };
    entries.iter().find_map(|entry| match &entry.kind {
        RobotEntryKind::Field(field) if field.name.name == "runs" => named(&field.value),
        _ => None,
    })
}

/// The name that is all of an expression, but for its arguments.
fn named(expr: &Expr) -> Option<&str> {
    match &expr.kind {
        ExprKind::Ref(reference) => Some(&reference.name.name),
        _ => None,
    }
}

/// The learner of that name, or the only one.
///
/// # Errors
/// There is none, or there are several and no name was given.
pub fn learner(loaded: &Loaded, name: Option<&str>) -> Result<Id<Learner>, Refused> {
    let learners = &loaded.program.learners;
    let names = learners.values().map(|learner| &learner.name);
    match name {
        Some(name) => learners
            .find(|learner| learner.name.is(name))
            .ok_or_else(|| missing(loaded, "learner", name, names)),
        None => only(loaded, "learn", names, learners.ids()),
    }
}

/// The task of a tree, or the only one.
///
/// # Errors
/// There is none, or there are several and the tree does not say which.
pub fn task_of(loaded: &Loaded, tree: Option<Id<Tree>>) -> Result<Id<Task>, Refused> {
    let program: &Program = &loaded.program;
    if let Some(task) = tree.and_then(|tree| program.trees[tree].task) {
        return Ok(task);
    }
    let names = program.tasks.values().map(|task| &task.name);
    only(loaded, "task", names, program.tasks.ids())
}

fn only<'n, T>(
    loaded: &Loaded,
    word: &str,
    names: impl Iterator<Item = &'n Name>,
    ids: impl Iterator<Item = Id<T>>,
) -> Result<Id<T>, Refused> {
    let ids: Vec<Id<T>> = ids.collect();
    let (message, label) = match ids.as_slice() {
        [one] => return Ok(*one),
        [] => (
            format!("the program has no `{word}` item"),
            format!("`{word} … {{ … }}` is missing"),
        ),
        _ => (
            format!(
                "the program has several `{word}` items: {}",
                name::list(names)
            ),
            match word {
                "learn" => "say which one with `--learner NAME`",
                "tree" => "say which one with `--tree NAME`",
                _ => "a tree says which one is meant: `tree NAME for TASK = …`",
            }
            .to_owned(),
        ),
    };
    let diagnostic = Diagnostic::new(Code::E0504, place_of(loaded, word), message).label(label);
    Err(Refused::program(loaded, [diagnostic]))
}

/// Why a tree that is declared is none that a command can take.
fn no_whole_tree(loaded: &Loaded, tree: &ast::Tree) -> Diagnostic {
    let (at, name) = (tree.name.span, &tree.name.name);
    if tree.params.is_some() {
        let message = format!("the tree `{name}` has parameters");
        let whole = format!(
            "declare a tree that gives them values, and name that one: `tree NAME = {name}(…)`"
        );
        return Diagnostic::new(Code::E0504, at, message)
            .label("what it does depends on their values")
            .help(whole);
    }
    if loaded.program.world.is_some() {
        let message = format!("another robot runs the tree `{name}`");
        return Diagnostic::new(Code::E0504, at, message)
            .label("this one is its script, and for no task")
            .help(format!(
                "`btc compile --tree {name} --emit svg` shows it, as other forms do"
            ))
            .help("a tree `for` a task is run by the robot that acts");
    }
    let message = format!("the tree `{name}` needs a world, and there is none");
    Diagnostic::new(Code::E0407, at, message).label("a world counts the ticks of its timeouts")
}

fn missing<'n>(
    loaded: &Loaded,
    what: &str,
    name: &str,
    names: impl Iterator<Item = &'n Name>,
) -> Refused {
    if what == "tree"
        && let Some(tree) = written(loaded, name)
    {
        return Refused::program(loaded, [no_whole_tree(loaded, tree)]);
    }
    let diagnostic = Diagnostic::new(
        Code::E0504,
        place_of(loaded, what),
        format!("the program has no {what} `{name}`"),
    );
    let names: Vec<String> = names.map(Name::to_string).collect();
    let label = match names.as_slice() {
        [] => format!("no {what} is declared in this file, nor in those that it uses"),
        _ => "this one has another name".to_owned(),
    };
    let diagnostic = diagnostic.label(label);
    let diagnostic = match suggest::nearest(name, names.iter().map(String::as_str)) {
        Some(likely) => diagnostic.help(format!("did you mean `{likely}`?")),
        None => diagnostic,
    };
    let diagnostic = match names.as_slice() {
        [] => diagnostic,
        // Which one is there, the place shows.
        [_] if !diagnostic.help.is_empty() => diagnostic,
        _ => diagnostic.help(format!("it has: {}", names.join(", "))),
    };
    Refused::program(loaded, [diagnostic])
}
