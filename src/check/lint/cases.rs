//! Conditions by cases: when one holds, as far as literals show.
//!
//! A case is a conjunction of literals, a condition a disjunction of cases. Whatever grows too large is taken to be
//! possible. What is not a number is left out of account, unless the reading is [strict](Numbers::Any).

use super::interval::Interval;
use super::ranges::{may_be, range, values};
use super::view::View;
use crate::ir::expr::{Binary, Expr, ExprId, Pose, Unary};
use crate::ir::law::Behavior;
use crate::ir::program::Stays;
use crate::ir::tree::{Atom, Guard, Status};
use crate::ir::world::Place;
use crate::ir::{Id, Pool, Program};
use rustc_hash::{FxHashMap, FxHashSet};
use std::cell::RefCell;
use std::collections::BTreeMap;

/// How many cases a condition may have.
const MOST: usize = 128;

/// How many literals a case keeps.
const LONGEST: usize = 64;

/// How deeply a condition may nest.
const DEEPEST: usize = 64;

/// How far beyond its bounds a shape may reach by rounding, in metres.
const SLACK: f64 = 1e-6;

/// The bits of how a behaviour ends in a tick: so, or so, or not at all.
const SUCCEEDED: u64 = 0b001;
const FAILED: u64 = 0b010;
const NEITHER: u64 = 0b100;
const ENDINGS: u64 = SUCCEEDED | FAILED | NEITHER;

/// The bits of a state that is never true, and of one that always is.
const FALSE: u64 = 0b01;
const TRUE: u64 = 0b10;

/// What a literal is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum About {
    /// The truth of an expression.
    Truth(ExprId),
    /// The truth of an atom without a definition.
    Atom(Atom),
    /// The number that an expression is.
    Number(ExprId),
    /// Where the robot that reads is.
    At(Pose),
    /// Whether a behaviour has ended in this tick, and how.
    Ended(Id<Behavior>),
    /// What the only entry of the history is, by the bits of [`entry`].
    Last,
}

/// What a literal says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Says {
    Is(bool),
    Within(Interval),
    /// It is one of those values of an enum whose bits are set.
    Among(u64),
    /// It is not a number.
    NoNumber,
}

impl Says {
    /// Whether a behaviour has ended, as it says of [`About::Ended`].
    pub fn is_an_end(self) -> bool {
        matches!(self, Self::Among(among) if among & NEITHER == 0)
    }
}

/// What an expression of numbers may come to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Numbers {
    /// A number.
    Numbers,
    /// Also what is not a number, with which no comparison holds.
    Any,
}

/// A conjunction of literals, none of which contradicts another.
pub type Case = BTreeMap<About, Says>;

/// When a condition holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Cases {
    /// In one of these cases, and in no other.
    Some(Vec<Case>),
    /// Nothing is known.
    Unknown,
}

impl Cases {
    /// A condition that holds always, or never.
    pub fn constant(holds: bool) -> Self {
        Self::Some(if holds { vec![Case::new()] } else { Vec::new() })
    }

    /// Whether it cannot hold.
    pub fn is_never(&self) -> bool {
        matches!(self, Self::Some(cases) if cases.is_empty())
    }

    /// Whether it holds whatever else does.
    pub fn is_always(&self) -> bool {
        matches!(self, Self::Some(cases) if cases.iter().any(BTreeMap::is_empty))
    }

    /// Both hold.
    #[must_use]
    pub fn and(&self, other: &Self) -> Self {
        let (ours, theirs) = match (self, other) {
            (Self::Some(ours), Self::Some(theirs)) => (ours, theirs),
            (never, _) | (_, never) if never.is_never() => return Self::constant(false),
            // What is not known cannot rule anything out.
            (Self::Unknown, known) | (known, Self::Unknown) => return known.clone(),
        };
        if ours.len() * theirs.len() > MOST {
            return Self::Unknown;
        }
        let pairs = ours.iter().flat_map(|a| theirs.iter().map(move |b| (a, b)));
        Self::Some(pairs.filter_map(|(a, b)| joined(a, b)).collect())
    }

    /// One of them holds.
    #[must_use]
    pub fn or(&self, other: &Self) -> Self {
        match (self, other) {
            (Self::Some(ours), Self::Some(theirs)) if ours.len() + theirs.len() <= MOST => {
                Self::Some(ours.iter().chain(theirs).cloned().collect())
            }
            _ => Self::Unknown,
        }
    }

    /// Whether all of its cases, as far as they are known, are so.
    pub fn all(&self, is_so: impl FnMut(&Case) -> bool) -> bool {
        matches!(self, Self::Some(cases) if cases.iter().all(is_so))
    }

    /// Whether the other one holds wherever this one does; false where that is not known.
    pub fn implies(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Some(ours), Self::Some(theirs)) => {
                ours.iter().all(|a| theirs.iter().any(|b| covers(b, a)))
            }
            _ => false,
        }
    }

    /// The one thing that all of its cases are about.
    pub fn about(&self) -> Option<About> {
        let Self::Some(cases) = self else {
            return None;
        };
        let mut abouts = cases.iter().flat_map(|case| case.keys());
        let first = *abouts.next()?;
        let all = cases.iter().all(|case| case.len() == 1);
        (all && abouts.all(|about| *about == first)).then_some(first)
    }

    fn one(about: About, says: Says) -> Self {
        Self::Some(vec![Case::from([(about, says)])])
    }
}

/// Both cases at once; `None` if they contradict each other.
fn joined(a: &Case, b: &Case) -> Option<Case> {
    let mut case = a.clone();
    for (about, says) in b {
        let says = match (case.get(about), says) {
            (None, _) if case.len() >= LONGEST => continue,
            (None, says) => *says,
            (Some(Says::Within(a)), Says::Within(b)) => {
                Says::Within(Some(a.and(*b)).filter(|both| !both.is_empty())?)
            }
            (Some(Says::Among(a)), Says::Among(b)) => {
                Says::Among(Some(a & b).filter(|both| *both != 0)?)
            }
            (Some(a), b) => Some(*a).filter(|a| a == b)?,
        };
        case.insert(*about, says);
    }
    Some(case)
}

/// Whether the wider case holds wherever the narrower one does.
fn covers(wider: &Case, narrower: &Case) -> bool {
    wider
        .iter()
        .all(|(about, wide)| match (wide, narrower.get(about)) {
            (Says::Within(wide), Some(Says::Within(narrow))) => wide.covers(*narrow),
            (Says::Among(wide), Some(Says::Among(narrow))) => narrow & !wide == 0,
            (wide, narrow) => narrow == Some(wide),
        })
}

/// When an expression is true, or when it is not, as `wanted` says.
pub fn of_expr<'p>(view: impl Into<View<'p>>, id: ExprId, wanted: bool) -> Cases {
    when(view.into(), id, wanted, Numbers::Numbers)
}

/// As [`of_expr`], where numbers may come to `numbers`.
pub fn when(view: View, id: ExprId, wanted: bool, numbers: Numbers) -> Cases {
    let known = RefCell::default();
    let reader = Reader {
        view,
        numbers,
        known,
    };
    reader.expr(id, wanted, 0)
}

/// The conditions that have to hold for one to hold, each once, those of the events in it among them.
pub fn conjuncts(program: &Program, id: ExprId) -> Vec<ExprId> {
    let mut seen = FxHashSet::default();
    let mut open = vec![id];
    let mut found = Vec::new();
    while let Some(id) = open.pop() {
        if !seen.insert(id) {
            continue;
        }
        match program.pool.get(id) {
            Expr::Event(event) => open.push(program.events[event].when),
            Expr::Binary(Binary::And, a, b) => open.extend([b, a]),
            _ => found.push(id),
        }
    }
    found
}

/// When a guard holds, or when it does not, as `wanted` says.
pub fn of_guard(program: &Program, guard: &Guard, wanted: bool) -> Cases {
    let parts = |guards: &[Guard], all: bool| {
        let parts = guards.iter().map(|guard| of_guard(program, guard, wanted));
        let first = Cases::constant(all == wanted);
        parts.fold(first, |so_far, part| match all == wanted {
            true => so_far.and(&part),
            false => so_far.or(&part),
        })
    };
    match guard {
        Guard::Const(value) => Cases::constant(*value == wanted),
        Guard::Not(guard) => of_guard(program, guard, !wanted),
        Guard::And(guards) => parts(guards, true),
        Guard::Or(guards) => parts(guards, false),
        Guard::Atom(Atom::Predicate(id)) if let Some(when) = program.predicates[*id].when => {
            let view = View::of(program, &program.predicates[*id].name);
            of_expr(view, when, wanted)
        }
        Guard::Atom(atom) => match entry(program, *atom) {
            Some(bit) => {
                let among = if wanted { bit } else { !bit };
                Cases::one(About::Last, Says::Among(among))
            }
            None => Cases::one(About::Atom(*atom), Says::Is(wanted)),
        },
    }
}

/// The bit of what the history says by `done(b)` or `failed(b)`, where all histories of the program have one entry: no two
/// of these hold at once. The last bit is left for a history in which nothing stands yet.
pub fn entry(program: &Program, atom: Atom) -> Option<u64> {
    let (behavior, failed) = match atom {
        Atom::Predicate(_) => return None,
        Atom::Done(behavior) => (behavior, false),
        Atom::Failed(behavior) => (behavior, true),
    };
    let at = 2 * behavior.index() + usize::from(failed);
    let single = program
        .tasks
        .iter()
        .all(|(_, task)| task.history.window <= 1);
    (program.world.is_some() && single && at + 1 < u64::BITS as usize).then(|| 1 << at)
}

/// Reads conditions.
struct Reader<'p> {
    view: View<'p>,
    numbers: Numbers,
    /// What has been read: events and shared expressions may stand in many places.
    known: RefCell<FxHashMap<(ExprId, bool), Cases>>,
}

impl Reader<'_> {
    fn expr(&self, id: ExprId, wanted: bool, depth: usize) -> Cases {
        if depth > DEEPEST {
            return Cases::Unknown;
        }
        if let Some(known) = self.known.borrow().get(&(id, wanted)) {
            return known.clone();
        }
        let found = self.read(id, wanted, depth);
        self.known.borrow_mut().insert((id, wanted), found.clone());
        found
    }

    fn read(&self, id: ExprId, wanted: bool, depth: usize) -> Cases {
        let pool = &self.view.program.pool;
        let of = |id, wanted| self.expr(id, wanted, depth + 1);
        match pool.get(id) {
            Expr::Bool(value) => Cases::constant(value == wanted),
            Expr::Unary(Unary::Not, a) => of(a, !wanted),
            Expr::Binary(op @ (Binary::And | Binary::Or), a, b) => {
                let (a, b) = (of(a, wanted), of(b, wanted));
                if (op == Binary::And) == wanted {
                    a.and(&b)
                } else {
                    a.or(&b)
                }
            }
            Expr::Event(event) => of(self.view.program.events[event].when, wanted),
            Expr::Binary(op @ (Binary::Eq | Binary::Ne), a, b) if truth(pool, b).is_some() => {
                let is = truth(pool, b) == Some(op == Binary::Eq);
                of(a, wanted == is)
            }
            variable @ (Expr::State(_) | Expr::Local(_) | Expr::Temp(_)) => {
                match self.view.stays(variable) {
                    Some(Stays::Among(FALSE)) => Cases::constant(!wanted),
                    Some(Stays::Among(TRUE)) => Cases::constant(wanted),
                    _ => Cases::one(About::Truth(id), Says::Is(wanted)),
                }
            }
            Expr::Visible(..) if self.view.open => Cases::constant(wanted),
            Expr::Inside(place) if self.is_in(place) => Cases::constant(wanted),
            Expr::Inside(place) if wanted => self.inside(id, place),
            Expr::Ended(behavior, status) if status != Status::Running => {
                let bit = match status {
                    Status::Success => SUCCEEDED,
                    _ => FAILED,
                };
                let among = if wanted { bit } else { ENDINGS & !bit };
                Cases::one(About::Ended(behavior), Says::Among(among))
            }
            Expr::Binary(op, a, b) => {
                let compared = self.compared(op, a, b, wanted);
                compared.unwrap_or_else(|| Cases::one(About::Truth(id), Says::Is(wanted)))
            }
            _ => Cases::one(About::Truth(id), Says::Is(wanted)),
        }
    }

    fn is_in(&self, place: Id<Place>) -> bool {
        let world = self.view.program.world.as_ref();
        world.is_some_and(|world| self.view.is_in(&world.places[place].shape))
    }

    /// A robot that is in a place is within its bounds.
    fn inside(&self, id: ExprId, place: Id<Place>) -> Cases {
        let mut case = Case::from([(About::Truth(id), Says::Is(true))]);
        let world = self.view.program.world.as_ref();
        if let Some(world) = world {
            let ([left, bottom], [right, top]) = world.places[place].shape.bounds();
            for (pose, low, high) in [(Pose::X, left, right), (Pose::Y, bottom, top)] {
                let within = Interval::between(low - SLACK, high + SLACK);
                case.insert(About::At(pose), Says::Within(within));
            }
        }
        Cases::Some(vec![case])
    }

    /// The case in which a number is within an interval. A distance that is no greater than so much bounds where the robot is.
    fn within(&self, of: ExprId, within: Interval) -> Case {
        let pool = &self.view.program.pool;
        let mut case = Case::new();
        if let Expr::Binary(Binary::Hypot, dx, dy) = pool.get(of) {
            let (_, most) = within.ends();
            let side = Interval::between(-most - SLACK, most + SLACK);
            for part in [dx, dy] {
                if let Some((pose, within)) = place(pool, part, side) {
                    case.insert(About::At(pose), Says::Within(within));
                }
            }
        }
        case.insert(about(pool, of), Says::Within(within));
        case
    }

    /// When a comparison holds, or does not, as far as that is known.
    fn compared(&self, op: Binary, a: ExprId, b: ExprId, wanted: bool) -> Option<Cases> {
        let of_itself = match op {
            _ if a != b || self.numbers == Numbers::Any => None,
            Binary::Eq | Binary::Le => Some(true),
            Binary::Ne | Binary::Lt => Some(false),
            _ => None,
        };
        let bounded = |op| {
            let known = self.numbers == Numbers::Numbers;
            known.then(|| bounded(&self.view.program.pool, op, a, b))?
        };
        if let Some(holds) = of_itself.or_else(|| bounded(op)) {
            return Some(Cases::constant(holds == wanted));
        }
        let (of, within) = comparison(&self.view.program.pool, op, a, b, wanted)?;
        let holds = |value: f64| within.iter().flatten().any(|part| part.contains(value));
        if let Some(count) = values(self.view.program, of) {
            let may = may_be(self.view.program, of);
            let may = (0..count).filter(|index| *index >= 64 || may & 1 << index != 0);
            let among = may.clone().filter(|index| holds(*index as f64));
            return match among.clone().count() {
                0 => Some(Cases::constant(false)),
                all if all == may.count() => Some(Cases::constant(true)),
                _ if count > u64::BITS as usize => None,
                _ => {
                    let bits = among.fold(0, |bits, index| bits | 1 << index);
                    Some(Cases::one(About::Number(of), Says::Among(bits)))
                }
            };
        }
        if let (Binary::Eq | Binary::Ne, true) = (op, self.asks_for_part_of_a_count(a, b)) {
            return Some(Cases::constant(wanted == (op == Binary::Ne)));
        }
        let may = range(self.view, of);
        let within: Vec<Interval> = within.into_iter().flatten().collect();
        // Of all comparisons `!=` alone holds of what is not a number.
        let none = self.numbers == Numbers::Any && wanted == (op == Binary::Ne);
        if within.iter().any(|part| part.covers(may)) && (none || self.numbers == Numbers::Numbers)
        {
            return Some(Cases::constant(true));
        }
        let possible = within.into_iter().filter(|part| !part.and(may).is_empty());
        let within = possible.map(|within| self.within(of, within));
        let none = none.then(|| Case::from([(about(&self.view.program.pool, of), Says::NoNumber)]));
        Some(Cases::Some(within.chain(none).collect()))
    }

    /// Whether one of these counts something and the other is a constant that is no whole number.
    fn asks_for_part_of_a_count(&self, a: ExprId, b: ExprId) -> bool {
        let pool = &self.view.program.pool;
        let no_count = |id| pool.constant(id).is_some_and(|value| value.fract() != 0.0);
        no_count(a) && is_count(pool, b) || no_count(b) && is_count(pool, a)
    }
}

/// Whether an expression adds up whole numbers, some of which hang on conditions.
fn is_count(pool: &Pool, id: ExprId) -> bool {
    let mut seen = FxHashSet::default();
    let mut open = vec![id];
    while let Some(id) = open.pop() {
        if !seen.insert(id) {
            continue;
        }
        match pool.get(id) {
            Expr::Num(value) if value.fract() == 0.0 => {}
            Expr::Binary(Binary::Add | Binary::Sub | Binary::Mul, a, b) | Expr::Select(_, a, b) => {
                open.extend([a, b])
            }
            _ => return false,
        }
    }
    true
}

/// Whether a comparison with the least or the greatest of what is compared holds whatever that is: `min(x, y) <= x`.
fn bounded(pool: &Pool, op: Binary, a: ExprId, b: ExprId) -> Option<bool> {
    let of = |bound: Binary, whole: ExprId, part: ExprId| match pool.get(whole) {
        Expr::Binary(op, one, other) => op == bound && [one, other].contains(&part),
        _ => false,
    };
    match op {
        Binary::Le if of(Binary::Min, a, b) || of(Binary::Max, b, a) => Some(true),
        Binary::Lt if of(Binary::Max, a, b) || of(Binary::Min, b, a) => Some(false),
        _ => None,
    }
}

/// What a literal on a number is about.
fn about(pool: &Pool, of: ExprId) -> About {
    match pool.get(of) {
        Expr::Pose(pose @ (Pose::X | Pose::Y)) => About::At(pose),
        _ => About::Number(of),
    }
}

/// Where the robot is if its distance from a constant along an axis is within an interval.
fn place(pool: &Pool, difference: ExprId, within: Interval) -> Option<(Pose, Interval)> {
    let Expr::Binary(Binary::Sub, a, b) = pool.get(difference) else {
        return None;
    };
    let (low, high) = within.ends();
    let (pose, low, high) = match (pool.get(a), pool.get(b)) {
        (Expr::Pose(pose), Expr::Num(value)) => (pose, value + low, value + high),
        (Expr::Num(value), Expr::Pose(pose)) => (pose, value - high, value - low),
        _ => return None,
    };
    (pose != Pose::Heading).then(|| (pose, Interval::between(low, high)))
}

/// The truth value of a constant.
fn truth(pool: &Pool, id: ExprId) -> Option<bool> {
    match pool.get(id) {
        Expr::Bool(value) => Some(value),
        _ => None,
    }
}

/// A comparison with a constant: what is compared, and in which intervals it has to be.
pub(super) fn comparison(
    pool: &Pool,
    op: Binary,
    a: ExprId,
    b: ExprId,
    wanted: bool,
) -> Option<(ExprId, [Option<Interval>; 2])> {
    let (of, value, turned) = match (pool.constant(a), pool.constant(b)) {
        (None, Some(value)) => (a, value, false),
        (Some(value), None) => (b, value, true),
        _ => return None,
    };
    let open = op == Binary::Lt;
    let within = match op {
        Binary::Lt | Binary::Le => {
            let one = match (turned, wanted) {
                (false, true) => Interval::below(value, open),
                (false, false) => Interval::above(value, !open),
                (true, true) => Interval::above(value, open),
                (true, false) => Interval::below(value, !open),
            };
            [Some(one), None]
        }
        Binary::Eq | Binary::Ne if (op == Binary::Eq) == wanted => {
            [Some(Interval::just(value)), None]
        }
        Binary::Eq | Binary::Ne => [
            Some(Interval::below(value, true)),
            Some(Interval::above(value, true)),
        ],
        _ => return None,
    };
    Some((of, within))
}
