//! `btc decanonicalize`: from a policy table of any origin to a proved tree, in a program that declares its names.

use super::export;
use super::inputs::Inputs;
use super::load::{self, Loaded};
use super::refused::Refused;
use super::table::{self, Recorded};
use super::target;
use super::text::Text;
use crate::diagnostic::{Code, Diagnostic};
use crate::emit::bt;
use crate::emit::form::TreeForm;
use crate::ir::law::Behavior;
use crate::ir::task::Task;
use crate::ir::tree::Tree;
use crate::ir::{Id, Name, Program};
use crate::policy::reader::{Format, Given};
use crate::policy::table::{AtomName, Table};
use crate::policy::{Policy, decisions};
use crate::report::decanonicalised;
use crate::source::{FileId, Span};
use crate::tree::decanonicalise::{self, Care, Method, Order};
use crate::tree::prove::Refuted;

/// What a user may set.
#[derive(Clone, Copy, Debug)]
pub struct Options<'o> {
    /// The method that finds the tree.
    pub method: Method,
    /// The order of its units.
    pub order: Order,
    /// The effort of the search; see [`decanonicalise::Options::effort`].
    pub effort: u64,
    /// The value that a decision may lose against the table's; 0 for a tree that is equal to the table.
    pub slack: f64,
    /// How the table is written; `None` if that is to be seen.
    pub from: Option<Format>,
    /// The name of the tree.
    pub name: &'o str,
    /// The form to write.
    pub form: TreeForm,
}

impl Default for Options<'_> {
    fn default() -> Self {
        let usual = decanonicalise::Options::default();
        Self {
            method: usual.method,
            order: usual.order,
            effort: usual.effort,
            slack: 0.0,
            from: None,
            name: "learned",
            form: TreeForm::Bt,
        }
    }
}

/// A program whose names a table has.
#[derive(Clone, Copy, Debug)]
pub struct Named<'l> {
    /// The program.
    pub loaded: &'l Loaded,
    /// Where it is found from the place of the result; without a path, the whole of it stands before the tree.
    pub path: Option<&'l str>,
}

/// A policy with a program that has its names. The texts of the tables are no longer needed.
#[derive(Clone, Debug)]
pub struct Asked<'l> {
    program: Program,
    /// Where the names are from, and the task that the policy is for; `None` if they are declared.
    named: Option<(Named<'l>, Id<Task>)>,
    policy: Policy,
    /// The behaviours that each row allows, if some row allows several.
    allowed: Option<Vec<Vec<Id<Behavior>>>>,
    /// What the columns hold, if that is more than truth values.
    inputs: Option<Inputs>,
    /// The name of the table.
    source: String,
}

/// A tree made from a table.
#[derive(Clone, Debug)]
pub struct Made {
    /// The tree in its form.
    pub text: String,
    /// The program that declares the names of the table, with the tree.
    pub program: Program,
    /// The tree.
    pub tree: Id<Tree>,
    /// Warnings, in lines.
    pub warnings: Vec<String>,
    /// The report, in lines.
    pub report: Vec<String>,
}

/// Reads a table, and the record of the process under it. Its names are those of a program, if one is given.
///
/// # Errors
/// The mistakes of the texts.
pub fn read<'l>(
    text: Text,
    recorded: Option<Recorded>,
    named: Option<Named<'l>>,
    options: &Options,
) -> Result<Asked<'l>, Refused> {
    let (read, inputs) = match table::read(text, options.from)? {
        Given::Truths(table) => (table, None),
        Given::Values(values) => {
            let (inputs, table) = Inputs::of(values, text, options.name)?;
            (table, Some(inputs))
        }
    };
    let at_header = |code, message: String| {
        let span = |file| Span::new(file, read.header.start, read.header.end);
        move |file: FileId| Diagnostic::new(code, span(file), message)
    };
    if inputs.is_some() && (options.slack > 0.0 || recorded.is_some()) {
        let message = "a table of values has neither slack nor transitions";
        let found = at_header(Code::E0826, message.to_owned());
        return Err(Refused::text(text, |file| vec![found(file)]));
    }
    if options.slack > 0.0 && !read.has_values() {
        let found = at_header(
            Code::E0817,
            "slack needs the values of the behaviours".to_owned(),
        );
        let help = "a column `q:NAME` for each behaviour says what it is worth";
        return Err(Refused::text(text, |file| vec![found(file).help(help)]));
    }
    if options.slack > 0.0
        && let Some((name, place)) = read.without_values()
    {
        let message = format!("slack needs the values of `{name}`");
        let help = format!("a column `q:{name}` says what it is worth");
        return Err(Refused::text(text, |file| {
            let span = Span::new(file, place.start, place.end);
            vec![Diagnostic::new(Code::E0817, span, message).help(help)]
        }));
    }
    let input = |inputs: &Inputs| inputs.has(options.name).then_some("an input");
    if inputs.is_some() && named.is_some() {
        let message =
            "a table of values declares its own inputs, and takes no names from a program";
        let found = at_header(Code::E0826, message.to_owned());
        return Err(Refused::text(text, |file| vec![found(file)]));
    }
    let what = match named {
        Some(named) => item(&named.loaded.program, options.name),
        None => names(&read, options.name).or_else(|| inputs.as_ref().and_then(input)),
    };
    if let Some(what) = what {
        let found = at_header(
            Code::E0816,
            format!("`{}` is the tree and {what}", options.name),
        );
        let help = "choose another name for the tree, with `--name NAME`";
        return Err(Refused::text(text, |file| vec![found(file).help(help)]));
    }
    if read.has_sets() && (options.slack > 0.0 || recorded.is_some()) {
        let message = "a row that allows several behaviours has neither slack nor transitions";
        let found = at_header(Code::E0823, message.to_owned());
        let help = "choose one behaviour for each row, or leave out the option";
        return Err(Refused::text(text, |file| vec![found(file).help(help)]));
    }
    let named = match named {
        Some(named) => Some((named, target::task_of(named.loaded, None)?)),
        None => None,
    };
    let (mut program, policy) = match named {
        Some((Named { loaded, .. }, task)) => {
            let program = loaded.program.clone();
            let policy = decisions::of_program(&read, &program, Some(task));
            (
                program,
                policy.map_err(|errors| table::refused(text, &errors))?,
            )
        }
        None => decisions::declared(&read),
    };
    if let Some(inputs) = &inputs {
        inputs.declare(&mut program);
    }
    let sets = read.has_sets().then(|| {
        let of = |numbers: Vec<usize>| {
            let ids = numbers.into_iter().map(Id::new);
            ids.collect()
        };
        read.allowed().map(of).collect()
    });
    let mut asked = Asked {
        program,
        named,
        policy,
        allowed: sets,
        inputs,
        source: called(text.name),
    };
    if let Some(recorded) = recorded {
        table::record(&mut asked.policy, &asked.program, recorded)?;
    }
    Ok(asked)
}

/// What has this name in a table.
fn names(table: &Table, name: &str) -> Option<&'static str> {
    let predicate = AtomName::Predicate(name.to_owned());
    if table.atoms.iter().any(|(atom, _)| *atom == predicate) {
        Some("a predicate")
    } else if table.behaviors.iter().any(|(known, _)| known == name) {
        Some("a behaviour")
    } else {
        None
    }
}

/// What has this name in a program.
fn item(program: &Program, name: &str) -> Option<&'static str> {
    let is = |known: &Name| known.is(name);
    if program.predicates.values().any(|found| is(&found.name)) {
        Some("a predicate of the program")
    } else if program.behaviors.values().any(|found| is(&found.name)) {
        Some("a behaviour of the program")
    } else if program.trees.values().any(|found| is(&found.name)) {
        Some("a tree of the program")
    } else {
        None
    }
}

/// The last part of a path, on one line; standard input has none.
fn called(name: &str) -> String {
    match name.rsplit('/').next() {
        Some("<stdin>") | None => "a table".to_owned(),
        Some(last) => last.replace(char::is_control, " "),
    }
}

/// Makes the tree and proves it.
///
/// # Errors
/// The tree is refuted, which is a bug of btc.
pub fn decanonicalize(asked: Asked, options: &Options) -> Result<Made, Refused> {
    let wanted = decanonicalise::Options {
        tight: true,
        method: options.method,
        care: Care::Seen,
        order: options.order,
        effort: options.effort,
    };
    let Asked {
        mut program,
        named,
        mut policy,
        allowed,
        inputs,
        source,
    } = asked;
    let refused = |refuted: Refuted| internal(&source, &refuted.to_string());
    let exact = match &allowed {
        Some(allowed) => {
            let found = decanonicalise::allowing(&policy, allowed, &wanted);
            let (chosen, found) = found.map_err(refused)?;
            policy = chosen;
            found
        }
        None => decanonicalise::decanonicalise(&policy, &wanted).map_err(refused)?,
    };
    let loosened = if options.slack > 0.0 {
        decanonicalise::loosen(&policy, &exact, &wanted, options.slack)
    } else {
        None
    };
    let found = loosened.as_ref().map_or(&exact, |loosened| &loosened.found);
    let report = decanonicalised::Report {
        policy: &policy,
        several: match (&inputs, allowed) {
            (Some(inputs), _) => inputs.several(),
            (None, Some(rows)) => rows.iter().filter(|all| all.len() > 1).count(),
            (None, None) => 0,
        },
        values: inputs.as_ref().map(Inputs::figures),
        exact: &exact,
        loosened: loosened.as_ref(),
        slack: options.slack,
    };
    let id = program.trees.push(Tree {
        name: Name::word(options.name),
        docs: vec![report.doc(&source)],
        task: named.map(|(_, task)| task),
        root: found.root.clone(),
    });
    let origin = [format!("Made by `btc decanonicalize` from {source}.")];
    let written = match (&inputs, named) {
        (None, Some((Named { loaded, path }, _))) => {
            let item = bt::tree(&program, &program.trees[id]);
            export::beside(loaded, path, &origin.concat(), &item)
        }
        (None, None) => bt::declared(&program, &origin),
        (Some(inputs), _) => {
            let text = inputs.written(&program, &program.trees[id], &origin);
            let proved = inputs.prove(&program, &program.trees[id], &text);
            proved.map_err(|why| internal(&source, &why))?;
            text
        }
    };
    let text = match options.form {
        TreeForm::Bt => written,
        form => {
            let mut tree = program.trees[id].clone();
            if let (Some((Named { loaded, .. }, _)), true) = (named, form.is_for_robots()) {
                let file = loaded.sources.get(loaded.main);
                let file = file.map_or_else(String::new, |file| called(&file.name));
                tree = export::named_after(&file, &tree);
            }
            let legend = inputs.as_ref().filter(|_| form.is_for_robots());
            let legend = legend.map(|inputs| inputs.legend(&program, &tree));
            if let Some(legend) = legend.filter(|lines| !lines.is_empty()) {
                tree.docs.push(String::new());
                tree.docs.extend(legend);
            }
            let written = export::tree(&program, &tree, form, |_| Span::default());
            written.map_err(|mistake| Refused::text(nothing(&source), |_| vec![mistake]))?
        }
    };
    let (mut warnings, report) = (report.warnings(&program), report.lines(&program));
    if options.form == TreeForm::Bt && text.len() > load::MOST {
        warnings.extend(large(text.len()));
    }
    Ok(Made {
        text,
        program,
        tree: id,
        warnings,
        report,
    })
}

/// What is to be known of a program that btc itself does not read.
fn large(bytes: usize) -> [String; 2] {
    let mega = |bytes: usize| bytes.div_ceil(10_000) as f64 / 100.0;
    [
        format!(
            "warning: the tree comes to {} MB of text, and btc reads programs of at most {} MB",
            mega(bytes),
            mega(load::MOST)
        ),
        "  it is proved on the table, but `btc check` and `btc verify` refuse the file; fewer behaviours, or numbers rounded to \
         fewer values, make a smaller tree, and `--emit` writes this one for other tools"
            .to_owned(),
    ]
}

/// A bug of btc.
fn internal(source: &str, why: &str) -> Refused {
    Refused::text(nothing(source), |file| {
        let message = format!("the tree that was found is not equal to the table: {why}");
        vec![
            Diagnostic::new(Code::E0609, Span::new(file, 0, 0), message)
                .note("this is a mistake of btc itself; please report it with the table"),
        ]
    })
}

/// The text of a table that is no longer at hand.
fn nothing(source: &str) -> Text<'_> {
    Text {
        name: source,
        bytes: b"",
    }
}

#[cfg(test)]
mod tests {
    use super::{Code, Options, Text, TreeForm, decanonicalise, decanonicalize, read};

    /// No table leads here: the rows are taken away behind the reader's back.
    #[test]
    fn a_tree_that_is_refuted_is_a_bug_of_btc() {
        let options = Options {
            method: decanonicalise::Method::Search,
            order: decanonicalise::Order::Learned,
            effort: 1,
            slack: 0.0,
            from: None,
            name: "learned",
            form: TreeForm::Bt,
        };
        let table = Text {
            name: "policy.csv",
            bytes: b"low,behavior\n0,deliver\n1,dock\n",
        };
        let codes = read(table, None, None, &options)
            .and_then(|mut asked| {
                asked.policy.rows.clear();
                decanonicalize(asked, &options)
            })
            .map(|made| made.text)
            .map_err(|refused| refused.diagnostics.iter().map(|found| found.code).collect());
        assert_eq!(codes, Err(vec![Code::E0609]));
    }
}
