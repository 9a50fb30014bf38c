//! Diagnostics of worlds that do not run.

use super::load::Loaded;
use super::refused::Refused;
use super::target;
use crate::diagnostic::{Code, Diagnostic};
use crate::trial::Unplayable;
use crate::world::BuildError;

/// A world that cannot be built.
pub(super) fn unbuilt(loaded: &Loaded, error: &BuildError) -> Diagnostic {
    let message = format!("the world cannot be built: {error}");
    // Of one place to start at it is clear which one is meant.
    if let BuildError::StartBlocked(_, robot) = error
        && let [at] = target::positions(loaded, robot.as_ref()).as_slice()
    {
        return Diagnostic::new(Code::E0409, *at, message).label("no room here");
    }
    Diagnostic::new(Code::E0409, target::world_span(loaded), message).label("this world")
}

/// A tree or a policy that cannot be played.
pub(super) fn unplayable(loaded: &Loaded, why: impl Into<Unplayable>) -> Refused {
    let program = &loaded.program;
    let diagnostic = match why.into() {
        Unplayable::World(error) => unbuilt(loaded, &error),
        Unplayable::Declared(id) => Diagnostic::new(
            Code::E0207,
            target::end_of_file(loaded),
            format!(
                "the behaviour `{}` is declared only and cannot be run",
                program.behaviors[id].name
            ),
        )
        .label("its definition is missing"),
        Unplayable::Unknown(atom) => Diagnostic::new(
            Code::E0409,
            target::world_span(loaded),
            format!(
                "the world does not say whether `{}` holds",
                program.atom_name(atom)
            ),
        ),
    };
    Refused::program(loaded, [diagnostic])
}
