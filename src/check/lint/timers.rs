//! Times that are set and do not run: nothing counts them down, or up.

use super::stays::{Set, of_block, set_at_starts, set_in_ticks};
use crate::check::Checker;
use crate::check::report::short;
use crate::diagnostic::Code;
use crate::ir::expr::{Binary, Expr};
use crate::ir::program::State;
use crate::ir::world::World;
use crate::ir::{Id, Pool, Program};
use crate::syntax::ast::{self, ExprKind, Item, ItemKind};
use std::collections::BTreeMap;

/// The units of time.
const UNITS: [&str; 4] = ["ms", "s", "min", "h"];

/// A time that stays where it is set.
struct Still {
    /// The value that it is set to.
    set: f64,
    /// Whether it is to fall from there.
    falls: bool,
}

impl<'a> Checker<'a> {
    /// Warns of states that are times, that effects set beyond a value that something asks for, and that nothing brings back.
    pub fn times_that_do_not_run(&mut self, items: impl Iterator<Item = &'a Item>) {
        let mut set = set_in_ticks(&self.program);
        for effect in self.program.effects.iter() {
            of_block(&effect.block, World::acting(), &mut set);
        }
        let mut begins = Set::new();
        set_at_starts(&self.program, &mut begins);
        let asked = compared(&self.program.pool);
        let mut families: BTreeMap<&str, Vec<Id<State>>> = BTreeMap::new();
        for (id, state) in self.program.states.iter() {
            families.entry(&state.name.family).or_default().push(id);
        }
        let mut still = Vec::new();
        for item in items {
            let ItemKind::State(declared) = &item.kind else {
                continue;
            };
            let name = &declared.name;
            if !is_time(declared) || self.is_told_within(Code::W0205, name.span) {
                continue;
            }
            let own = families.get(name.name.as_str()).into_iter().flatten();
            let own = own.map(|id| {
                let asked = asked.get(id).map_or(&[][..], Vec::as_slice);
                stays(&self.program, *id, asked, [&set, &begins])
            });
            let own: Option<Vec<Still>> = own.collect();
            still.extend(
                own.and_then(|own| own.into_iter().next())
                    .map(|it| (declared, it)),
            );
        }
        for (declared, Still { set, falls }) in still {
            let name = &declared.name;
            let (message, run) = match falls {
                true => (
                    format!("nothing counts `{}` down", name.name),
                    format!("{0} = max({0} - tick, 0 s)", name.name),
                ),
                false => (
                    format!("nothing counts `{}` up", name.name),
                    format!("{} += tick", name.name),
                ),
            };
            let help = match &declared.params {
                None => format!("a time does not run by itself: `each tick {{ {run} }}`"),
                Some(_) => "a time does not run by itself: let it, in `each tick`".to_owned(),
            };
            self.warning(Code::W0313, name.span, message)
                .label(format!("once it is {} s, it stays there", short(set)))
                .help(help);
        }
    }
}

/// The value of a time that stays where it is set, beyond a value that something asks for and that it begins on the other side of.
fn stays(
    program: &Program,
    id: Id<State>,
    asked: &[f64],
    [set, begins]: [&Set; 2],
) -> Option<Still> {
    let pool = &program.pool;
    let constants = |of: &Set| {
        let settings = of.get(&id).map_or(&[][..], Vec::as_slice);
        let values = settings.iter().map(|(_, value)| pool.constant(*value));
        values.collect::<Option<Vec<f64>>>()
    };
    let set = constants(set)?;
    let mut first = constants(begins)?;
    first.extend(pool.constant(program.states[id].initial));
    let value = *set.first()?;
    asked.iter().find_map(|&asked| {
        let beyond = |values: &[f64], above: bool| {
            let mut values = values.iter();
            values.all(|it| if above { *it > asked } else { *it < asked })
        };
        // A countdown runs to nothing, a clock from nothing.
        let falls = asked == 0.0 && beyond(&set, true) && first.iter().any(|it| *it <= asked);
        let is_reset = set.contains(&0.0);
        let rises = is_reset && beyond(&set, false) && first.iter().any(|it| *it >= asked);
        (falls || rises).then_some(Still { set: value, falls })
    })
}

/// The constants that each state is compared with.
fn compared(pool: &Pool) -> BTreeMap<Id<State>, Vec<f64>> {
    let mut found: BTreeMap<Id<State>, Vec<f64>> = BTreeMap::new();
    for (_, expr) in pool.iter() {
        let Expr::Binary(Binary::Lt | Binary::Le, a, b) = expr else {
            continue;
        };
        for (of, with) in [(a, b), (b, a)] {
            if let (Expr::State(state), Some(value)) = (pool.get(of), pool.constant(with)) {
                found.entry(state).or_default().push(value);
            }
        }
    }
    found
}

/// Whether a state is declared as a time.
fn is_time(state: &ast::State) -> bool {
    if let Some(ty) = &state.ty {
        let named = |(name, _): &(ast::Ident, _)| name.name == "time";
        return ty.factors.len() == 1 && ty.factors.iter().all(named);
    }
    match &state.value.kind {
        ExprKind::Number(number) => {
            let unit = number.unit.as_ref().map(|unit| unit.text.as_str());
            unit.is_some_and(|unit| UNITS.contains(&unit))
        }
        _ => false,
    }
}
