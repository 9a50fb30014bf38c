//! A program once more, with something else in it.

use super::Loaded;
use crate::check;
use crate::diagnostic::Diagnostic;
use crate::ir::{Name, Program};
use crate::source::Source;
use crate::syntax;

impl Loaded {
    /// The program with other values for its tunables, in their units. Behaviours, predicates and trees keep their ids.
    /// `None` if it has mistakes under these values.
    pub fn revalued(&self, values: &[f64]) -> Option<Program> {
        let tuned = self.tunes.iter().zip(values);
        let tuned = tuned.flat_map(|(sites, value)| sites.iter().map(|site| (*site, *value)));
        let checked = check::check_with(&self.inputs(), tuned.collect());
        let program = checked.program;
        let wrong = checked.diagnostics.iter().any(Diagnostic::is_error);
        (!wrong && same_names(&self.program, &program)).then_some(program)
    }

    /// The program with more items at its end, and the mistakes in these, whose places are in `text`. Whatever has an id
    /// in the program keeps it. The program is usable only without mistakes.
    pub fn extended(&self, text: &str) -> (Program, Vec<Diagnostic>) {
        let mut extended = self.clone();
        let file = extended.sources.add(Source::new("", text));
        let (added, mut found) = syntax::parse(file, text);
        extended.ast.items.extend(added.items);
        let checked = check::check(&extended.inputs());
        found.extend(checked.diagnostics);
        found.retain(|found| found.is_error() && found.span().file == file);
        (checked.program, found)
    }
}

/// Whether what trees are made of has the same ids in both programs.
fn same_names(one: &Program, other: &Program) -> bool {
    let predicates = |program: &Program| -> Vec<Name> {
        let predicates = program.predicates.values();
        predicates.map(|predicate| predicate.name.clone()).collect()
    };
    let behaviors = |program: &Program| -> Vec<Name> {
        let behaviors = program.behaviors.values();
        behaviors.map(|behavior| behavior.name.clone()).collect()
    };
    predicates(one) == predicates(other) && behaviors(one) == behaviors(other)
}
