//! What is wrong with a program whose parts are all right: passes over the whole of it, once nothing else is wrong.
//!
//! They err on the side of silence: what they report does not depend on how the program runs.

mod apart;
mod bounds;
mod cases;
mod causes;
mod chains;
mod choices;
mod claims;
mod conditions;
mod effects;
mod ended;
mod endings;
mod exact;
mod exclusions;
mod follows;
mod geometry;
mod idle;
mod interval;
mod lasting;
mod late;
mod locals;
mod mentions;
mod moments;
mod overwritten;
mod predicates;
mod ranges;
mod reads;
mod redundant;
mod regions;
mod repaid;
mod resets;
mod rewards;
mod same;
mod settings;
mod sizes;
mod starts;
mod stays;
mod subtrees;
mod tests;
mod timers;
mod tree;
mod unused;
mod view;
mod widening;
mod world;
mod worth;

use super::{Checker, Input};
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::Program;
use crate::ir::expr::ExprId;
use crate::source::Span;
pub use bounds::Bounded;
pub use causes::Causes;
pub use chains::Links;
use conditions::Places;
pub use conditions::{Condition, is_nameless};
pub use effects::{Assigned, Assignments};
pub use endings::Asked;
pub use exact::Equality;
pub use exclusions::exclusions;
pub use mentions::Mentions;
pub use redundant::Joints;
pub use regions::FailClause;
pub use same::Again;
pub use sizes::Quantity;

/// The least that an expression may be, as far as its operators and the world tell.
pub fn least(program: &Program, id: ExprId) -> f64 {
    ranges::range(view::View::from(program), id).ends().0
}

impl<'a> Checker<'a> {
    /// The passes over the whole program, the main file being the last of the files.
    pub fn whole_program(&mut self, files: &[Input<'a>]) {
        let own = || files.iter().filter(|input| !input.library);
        let items = || own().flat_map(|input| &input.ast.items);
        if self.has_errors() || files.iter().any(|input| input.ast.lost.any) {
            return;
        }
        self.endings_that_never_come();
        self.blocked_places(items());
        if self.has_errors() {
            return;
        }
        let stay = self.values_of_states(items());
        self.values_of_locals(items());
        self.unread_names();
        self.unused_declarations(files);
        if self.kind_misspelt {
            return;
        }
        self.same_on_both_sides();
        self.values_overwritten(items());
        self.read_after_reset(items());
        self.effects_without_effect();
        self.bounds_on_the_wrong_side(items());
        self.times_that_do_not_run(items());
        let kept = self.bound_by_episodes(&stay);
        self.find_constant_predicates();
        self.conditions_without_effect();
        self.branches_never_taken();
        self.choices_alike(items());
        self.sides_of_clauses();
        self.regions_without_effect(items());
        let told = self.choices_that_never_succeed(items());
        self.calls_without_effect(&told);
        self.predicates_without_effect(items());
        self.observed_too_late(items());
        self.rewards_without_effect(items());
        self.settings_of_learners(items());
        self.moments_that_last(items());
        self.ends_at_starts(items());
        self.read_before_set(items());
        self.nodes_without_effect(items());
        self.subtrees_without_effect(items());
        self.claims_in_vain(items());
        self.tests_of_nowhere(items());
        self.sides_without_effect();
        self.parts_without_effect();
        self.passed_over();
        for (state, stays) in kept {
            self.program.states[state].stays = stays;
        }
        self.world_without_effect(items());
        self.sizes_out_of_proportion(items());
        self.without_what_follows(items());
    }

    fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(Diagnostic::is_error)
    }

    /// The places of which something has been told.
    fn told(&self) -> Places {
        let mut told = Places::default();
        let known = self.diagnostics.iter();
        known.for_each(|found| told.add(found.span()));
        told
    }

    /// Whether this has been told of a place within a span.
    fn is_told_within(&self, code: Code, span: Span) -> bool {
        let mut found = self.diagnostics.iter();
        found.any(|found| {
            let at = found.span();
            let within = at.file == span.file && span.start <= at.start && at.end <= span.end;
            found.code == code && within
        })
    }

    /// Whether the robot that learns is the only one.
    fn has_one_robot(&self) -> bool {
        let world = self.program.world.as_ref();
        world.is_none_or(|world| world.others.is_empty())
    }
}
