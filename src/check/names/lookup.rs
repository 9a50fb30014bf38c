//! Looking up a name where one kind of declaration is expected.

use super::Decl;
use crate::check::Checker;
use crate::check::builtin::{BuiltIn, Constant};
use crate::check::context::Region;
use crate::check::expr::plain_ref;
use crate::check::report::{Draft, LISTED};
use crate::check::types::Value;
use crate::diagnostic::{Applicability, Code, suggest};
use crate::ir::law::Behavior;
use crate::ir::task::Task;
use crate::ir::{Id, Name};
use crate::spelling::spelled;
use crate::syntax::ast::{self, BinaryOp, Expr, ExprKind, Ident, Ref};
use crate::syntax::words::{DRIVING, SHARED};

impl<'a> Checker<'a> {
    /// The declaration of a value's name as seen from the text at hand, with whether it is of the library.
    pub fn value_of(&mut self, name: &Ident) -> Option<(Decl<'a>, bool)> {
        let found = self.names.value(&name.name, self.context.library);
        if let Some((decl, _)) = found {
            self.stands_for(name, decl.ident().span);
        }
        found
    }

    /// What a reference of the user names, if `is` accepts it, with whether it is of the library; anything else is
    /// reported. `wanted` says what is accepted, with its article, and `help` what to do where it is something else.
    pub fn declared_as<T>(
        &mut self,
        reference: &Ref,
        wanted: &str,
        help: Option<String>,
        is: impl Fn(Decl<'a>) -> Option<T>,
    ) -> Option<(T, bool)> {
        let name = &reference.name;
        match self.value_of(name) {
            Some((decl, library)) => match is(decl) {
                Some(found) => Some((found, library)),
                None => self
                    .error(
                        Code::E0203,
                        reference.span,
                        format!("{wanted} is needed here"),
                    )
                    .label(format!("`{}` is {}", name.name, decl.what()))
                    .help_if(help)
                    .none(),
            },
            None if BuiltIn::named(&name.name).is_some()
                || Constant::named(&name.name).is_some() =>
            {
                self.error(
                    Code::E0203,
                    reference.span,
                    format!("{wanted} is needed here"),
                )
                .label(format!("`{}` is built in", name.name))
                .help_if(help)
                .none()
            }
            None => {
                let what = wanted.split_once(' ').map_or(wanted, |(_, what)| what);
                self.undeclared_value(name, what, |decl| is(decl).is_some())
                    .none()
            }
        }
    }

    /// The behaviour that a reference of the user names, with its arguments; anything else is reported.
    pub fn behavior_ref(&mut self, reference: &'a Ref) -> Option<Id<Behavior>> {
        let help = match self.names.value(&reference.name.name, self.context.library) {
            Some((Decl::Predicate(_), _)) => Some("predicates are listed by `observe`"),
            Some((Decl::State(_), _)) => {
                Some("what depends on a state is asked by a predicate, and listed by `observe`")
            }
            Some((Decl::Tree(_), _)) => Some("list the behaviours that the tree is made of"),
            _ => None,
        };
        let place = match self.names.value(&reference.name.name, self.context.library) {
            Some((Decl::Place(..), _)) => {
                let place = spelled(&reference.name.name);
                Some(format!("what brings the robot there: `goto({place})`"))
            }
            _ => None,
        };
        let help = help.map(str::to_owned).or(place);
        let (behavior, library) =
            self.declared_as(reference, "a behaviour", help, |decl| match decl {
                Decl::Behavior(behavior) => Some(behavior),
                _ => None,
            })?;
        match self.behavior_instance(behavior, library, reference)? {
            Value::Behavior(id) => Some(id),
            _ => None,
        }
    }

    /// The task of that name; one that nothing declares is reported.
    pub fn task_of(&mut self, name: &Ident) -> Option<Id<Task>> {
        match self.names.tasks.get(name.name.as_str()) {
            Some(task) => self.stands_for(name, task.name.span),
            None => {
                let likely = self.likely(&name.name, self.names.tasks.keys().copied());
                self.undeclared(name, "task", likely);
            }
        }
        let name = Name::word(&name.name);
        self.program.tasks.named(&name)
    }

    /// Reports the name of an enum or of a kind where one of its members is needed.
    pub fn not_one_of_them(&mut self, name: &Ident) -> Draft<'_> {
        let what = self.names.types.get(name.name.as_str());
        let what = what.map_or("a type", |ty| ty.what());
        let help = match what {
            "an enum" => format!(
                "name one of its variants, or range over all: `x in {}`",
                name.name
            ),
            _ => match self.by_chance(name) {
                Some(choice) => format!("name one of them, or let chance choose: `{choice}`"),
                None => format!("name one of them, or range over all: `x in {}`", name.name),
            },
        };
        let message = format!("`{}` is {what}, not one of them", name.name);
        self.error(Code::E0203, name.span, message)
            .label("one is needed here")
            .help(help)
    }

    /// What draws one of the places of a kind where a start is said, if they are few.
    fn by_chance(&self, kind: &Ident) -> Option<String> {
        let of_kind = self.kinds.places.iter();
        let of_kind = of_kind.filter(|(_, of)| of.as_deref() == Some(kind.name.as_str()));
        let names: Vec<String> = of_kind.map(|(place, _)| place.to_string()).collect();
        let is_short = (1..=LISTED).contains(&names.len());
        (is_short && self.context.region == Region::Start)
            .then(|| format!("one_of({})", names.join(", ")))
    }

    /// Reports an undeclared name where a `what` is expected, unless its declaration was not understood; `likely` is the name that was probably meant.
    pub fn undeclared(&mut self, name: &Ident, what: &str, likely: Option<&str>) -> Draft<'_> {
        if self.may_be_lost(&name.name) {
            return Draft::silent(&mut self.diagnostics);
        }
        if self.lacks_library(&name.name) {
            return self.library_is_missing(name);
        }
        if self.names.types.contains_key(name.name.as_str()) {
            return self.not_one_of_them(name);
        }
        if let Some((is, help)) = self.of_another_space(&name.name, what) {
            return self
                .error(
                    Code::E0203,
                    name.span,
                    format!("`{}` is {is}, not a {what}", name.name),
                )
                .label(format!("a {what} is needed here"))
                .help_if(help);
        }
        let place = self.names.value(&name.name, false);
        let place = place.filter(|(decl, _)| matches!(decl, Decl::Place(..) | Decl::Wall(..)));
        // A kind of targets is no misspelt name.
        let likely = likely.filter(|_| !matches!(name.name.as_str(), "place" | "wall"));
        // Nor is a word of logic.
        let of_logic = what.starts_with("function") && ranging(&name.name).is_some();
        let likely = likely.filter(|_| !of_logic);
        // Which type a number of another language has, its unit would say.
        let of_any_unit = what == "type" && is_a_plain_number(&name.name);
        let likely = likely.filter(|_| !of_any_unit);
        let input = self.input_with(&name.name);
        let likely = likely.filter(|_| input.is_none());
        let bound = what.starts_with("state") && self.context.ended.contains(name.name.as_str());
        let likely = likely.filter(|_| !bound);
        let hint = match (likely, place) {
            _ if bound => Some(format!(
                "a value is known in its block alone: `let {} = if … {{ … }} else {{ … }}`",
                spelled(&name.name)
            )),
            _ if input.is_some() => input.map(|input| {
                let (name, input) = (spelled(&name.name), spelled(input));
                format!("`{name}` is a value of `{input}`: `predicate NAME = {input} == {name}`")
            }),
            (Some(_), _) => None,
            (None, None) if of_any_unit => Some(MEASURED.to_owned()),
            (None, Some((decl, _))) if what == "type" => Some(format!(
                "`{0}` is {1}; members are of a kind, which stands behind their names: `{0}: KIND = …`",
                name.name,
                decl.what()
            )),
            (None, _) => hint(&name.name, what),
        };
        self.error(
            Code::E0202,
            name.span,
            format!("`{}` is not declared", name.name),
        )
        .label(format!("no {what} has this name"))
        .likely(name, likely)
        .help_if(hint)
    }

    /// The input that has a value of this name.
    pub fn input_with(&self, value: &str) -> Option<&'a str> {
        let has = |input: &ast::Input| match &input.kind {
            ast::InputKind::Category(values) => values.iter().any(|known| known.name == value),
            ast::InputKind::Number(_) => false,
        };
        let is = |decl| matches!(decl, Decl::Input(input) if has(input));
        self.names.values(is).next()
    }

    /// What a name stands for in another space than that in which a `what` is looked for, and what to do about it.
    fn of_another_space(&self, name: &str, what: &str) -> Option<(&'static str, Option<String>)> {
        match what {
            "tree" if self.names.tasks.contains_key(name) => {
                let mut trees = self.names.values(|decl| match decl {
                    Decl::Tree(tree) => tree.task.as_ref().is_some_and(|task| task.name == name),
                    _ => false,
                });
                let tree = trees
                    .next()
                    .map(|tree| format!("a tree for it is `{tree}`"));
                Some(("a task", tree))
            }
            "task" => {
                let (decl, _) = self.names.value(name, false)?;
                let mut tasks = self.names.tasks.keys();
                let task = tasks.next().filter(|_| self.names.tasks.len() == 1);
                Some((
                    decl.what(),
                    task.map(|task| format!("the task is `{task}`")),
                ))
            }
            _ => None,
        }
    }

    /// Reports an undeclared name where a declaration that `fits` is expected.
    pub fn undeclared_value(
        &mut self,
        name: &Ident,
        what: &str,
        fits: impl Fn(Decl<'a>) -> bool,
    ) -> Draft<'_> {
        let likely = self.likely(&name.name, self.names.values(fits));
        self.undeclared(name, what, likely)
    }

    /// Whether the library has a behaviour of this name and the program does not use the library.
    fn lacks_library(&self, name: &str) -> bool {
        let idle = self.names.value("idle", true);
        let used = idle.is_some_and(|(_, library)| library);
        !used && (DRIVING.contains(&name) || SHARED.contains(&name))
    }

    /// Reports, once, that the program does not use the library.
    fn library_is_missing(&mut self, name: &Ident) -> Draft<'_> {
        if std::mem::replace(&mut self.library_missed, true) {
            return Draft::silent(&mut self.diagnostics);
        }
        let called = &name.name;
        let top = self.names.top;
        let draft = self
            .error(
                Code::E0202,
                name.span,
                format!("`{called}` is not declared"),
            )
            .label(match DRIVING.contains(&called.as_str()) {
                true => "a behaviour of the library, which this program does not use",
                false => "of the library, which this program does not use",
            })
            .help(format!("`use std` brings `{called}`"));
        match top {
            Some(top) => draft.fix("use the library", top, "use std\n\n", Applicability::Safe),
            None => draft,
        }
    }

    /// Whether a name is that of a declaration that was not understood, or nearly.
    pub fn may_be_lost(&self, name: &str) -> bool {
        self.names.is_lost(name) || self.likely(name, self.names.all_lost()).is_some()
    }

    /// The name that was likely meant. A program has so many guesses: to look for the names of thousands among
    /// thousands would take too long.
    pub fn likely<'n>(&self, name: &str, known: impl Iterator<Item = &'n str>) -> Option<&'n str> {
        let left = self.guesses.get();
        let mut looked_at = 0;
        let known = known.inspect(|_| looked_at += 1).take(left);
        // Of names that are as near, that of a declaration which nothing uses.
        let found = suggest::nearest_rather(name, known, |near| self.names.is_unused(near));
        self.guesses.set(left - looked_at.min(left));
        found
    }

    /// Whether `battery-low` was to be one name, which a declaration that was not understood was to declare.
    pub fn is_lost_with_a_dash(&self, expr: &Expr) -> bool {
        matches!(expr.kind, ExprKind::Binary { .. })
            && dashed(expr).is_some_and(|joined| self.names.is_lost(&joined))
    }

    /// Reports an expression where a name is needed; `declaration` gives it one.
    pub fn not_named(&mut self, expr: &Expr, wanted: &str, declaration: &str) {
        if self.is_lost_with_a_dash(expr) {
            return;
        }
        let joined = match &expr.kind {
            ExprKind::Binary { op, left, right } => {
                let word = match op.node {
                    BinaryOp::And => "and",
                    _ => "or",
                };
                let joins = matches!(op.node, BinaryOp::And | BinaryOp::Or);
                let named =
                    |side: &Expr| matches!(side.kind, ExprKind::Ref(_) | ExprKind::Binary { .. });
                (joins && named(left) && named(right)).then_some((word, op.span))
            }
            _ => None,
        };
        if let Some((word, at)) = joined.filter(|_| wanted == "a behaviour") {
            let message = format!("behaviours are parted by commas, not by `{word}`");
            self.error(Code::E0203, at, message).label("write `,`");
            return;
        }
        if !matches!(expr.kind, ExprKind::Error) {
            self.error(Code::E0203, expr.span, format!("{wanted} is needed here"))
                .label("this is an expression without a name")
                .help(format!("declare one: `{declaration}`"));
        }
    }
}

/// The most words of a name that is written with dashes.
const WORDS: usize = 8;

/// The name that `battery-low` would be, if it is of words that touch.
fn dashed(expr: &Expr) -> Option<String> {
    let mut words: Vec<&str> = Vec::new();
    let mut left = expr;
    while let ExprKind::Binary {
        op,
        left: next,
        right,
    } = &left.kind
    {
        let touching = next.span.end == op.span.start && op.span.end == right.span.start;
        let right = plain_ref(right).filter(|name| touching && name.args.is_none())?;
        if op.node != BinaryOp::Sub || words.len() >= WORDS {
            return None;
        }
        words.push(&right.name.name);
        left = next;
    }
    words.push(
        &plain_ref(left)
            .filter(|name| name.args.is_none())?
            .name
            .name,
    );
    words.reverse();
    Some(words.join("_"))
}

/// What says here what logic and other languages call so.
fn ranging(name: &str) -> Option<&'static str> {
    Some(match name {
        "exists" | "some" => "any(x in KIND: …)",
        "forall" | "every" | "each" => "all(x in KIND: …)",
        "none" | "nobody" => "not any(x in KIND: …)",
        _ => return None,
    })
}

/// What is said to who takes any number for a `number`.
const MEASURED: &str = "a plain one is a `number`, which has no unit; what is measured is a `length`, a `time`, an `angle`, a `speed`, a `ratio`";

/// Whether other languages call the numbers so that have no whole values.
fn is_a_plain_number(name: &str) -> bool {
    matches!(
        name,
        "float" | "double" | "real" | "decimal" | "f32" | "f64"
    )
}

/// What helps who writes such a name.
fn hint(name: &str, what: &str) -> Option<String> {
    Some(match name {
        "self" | "this" | "me" | "robot" => {
            "the robot at hand is never named: `distance(p)` is read from where it is".to_owned()
        }
        _ if what == "type" && crate::check::unit(name).is_some() => {
            "a type says what is measured, not by what: `length`, `time`, `angle`, `speed`, `ratio`"
                .to_owned()
        }
        "place" | "wall" if what.starts_with("state") => {
            format!("one of them is called by its name, and all of them are `x in {name}`")
        }
        "at" | "reached" | "arrived" if what.starts_with("function") => {
            "whether the robot is in a place: `inside(PLACE)`".to_owned()
        }
        "near" | "close" | "close_to" | "is_near" if what.starts_with("function") => {
            "how far something is: `distance(PLACE) < 50 cm`".to_owned()
        }
        "see" | "can_see" | "detect" | "detected" if what.starts_with("function") => {
            "whether something is in sight: `visible(PLACE)`".to_owned()
        }
        "print" | "println" | "printf" | "log" | "debug" | "rospy" | "echo"
            if what == "statement" =>
        {
            "a program prints nothing: `btc run FILE --trace -` shows what happens".to_owned()
        }
        "stop" | "halt" | "brake" if what == "statement" => {
            "in a tick without `drive` the robot stands".to_owned()
        }
        "x" | "y" if what.starts_with("state") && what.ends_with("name") || what == "state" => {
            "where the robot is: `position.x`; where it starts: `position = (1 m, 2 m)`".to_owned()
        }
        "x" | "y" if what.starts_with("state") => format!("where the robot is: `position.{name}`"),
        "yes" | "no" if what.starts_with("state") => {
            "truth values are `true` and `false`".to_owned()
        }
        "scanner" | "range_finder" | "beacon" | "SCANNER" | "RANGE_FINDER" | "BEACON"
        | "Scanner" | "Beacon" | "RangeFinder"
            if what.starts_with("state") =>
        {
            "a sensor is read by the name that the robot gives it: `sensor NAME = …`".to_owned()
        }
        "Vector2" | "Vec2" | "vec2" | "vec" | "point" | "Point" | "Vector" | "vector" | "Vector3" | "Pose2D"
        | "Pose" => "a point is written `(1 m, 2 m)`".to_owned(),
        _ if what.starts_with("function") && ranging(name).is_some() => {
            let form = ranging(name).unwrap_or_default();
            format!("what holds of the members of a kind: `{form}`")
        }
        "collision" | "collides" | "hit" | "contact" if what.starts_with("function") => {
            "whether the robot touches anything: `touching`; how near another one is: `distance(ROBOT) < 50 cm`".to_owned()
        }
        "sum" | "average" | "mean" if what.starts_with("function") => {
            "members are counted, `count(x in KIND: …)`; a sum is written out".to_owned()
        }
        "default" | "otherwise" | "_" if what.ends_with("predicate") => {
            "what is done else is the last child of a `selector`, without a guard".to_owned()
        }
        "reward" | "score" if what == "variable" => {
            "a task says what is rewarded: `reward { on EVENT: NUMBER }`".to_owned()
        }
        "SubTree" | "Subtree" | "SubTreePlus" | "subtree" => {
            "a tree stands in another one by its name: `NAME`, `NAME(ARGUMENT)`".to_owned()
        }
        "north" | "south" | "east" | "west" | "up" | "down" if what.starts_with("state") => {
            "directions are angles: `0 deg` is along x, `90 deg` along y".to_owned()
        }
        "inf" | "infinity" | "Infinity" | "INF" => {
            "no number is infinite: take one that is large enough".to_owned()
        }
        "pi" | "PI" => "half a turn is `180 deg`".to_owned(),
        "speed" | "turn" | "velocity" if what == "variable" => {
            "a motion is commanded by `drive(speed = …, turn = …)`".to_owned()
        }
        _ if what.starts_with("parameter") => return None,
        "s" | "ms" | "second" | "seconds" | "minute" | "minutes" | "hour" | "cm" | "mm" | "deg"
        | "rad" => {
            let unit = match name {
                "second" | "seconds" => "s",
                "minute" | "minutes" => "min",
                "hour" => "h",
                unit => unit,
            };
            match name {
                "s" | "ms" | "cm" | "mm" | "deg" | "rad" => {
                    format!("a unit follows a number, in one piece: `1 {unit}`, `1 m/s`")
                }
                _ => format!("a unit follows a number, in one piece: `1 {unit}`, `per 1 {unit}`"),
            }
        }
        "s2" | "m2" | "cm2" => {
            let unit = name.trim_end_matches('2');
            format!("a square has a `^`: `1 {unit}^2`, `1 m/s^2`")
        }
        "step" | "decision" => {
            "decisions are counted by `per decision`, time by `per 1 s`".to_owned()
        }
        "success" | "failure" | "running" if what.starts_with("behaviour") => {
            "what succeeds at once is `true`; what a node answers is changed by `succeed { … }`, `fail { … }`".to_owned()
        }
        "drive" if what.starts_with("behaviour") => {
            "`drive` is a statement of a behaviour: `behavior NAME { control { drive(…) } }`".to_owned()
        }
        "timeout" if what == "predicate" || what == "event" => {
            "a limit of time is said by `end after 10 min`".to_owned()
        }
        "timeout" | "retry" | "repeat" | "parallel" => {
            format!("the children of a node stand in braces: `{name}(…) {{ … }}`")
        }
        "selector" | "sequence" | "invert" | "succeed" | "fail" => {
            format!("the children of a node stand in braces: `{name} {{ … }}`")
        }
        _ if matches!(what, "predicate" | "event") => {
            format!(
                "if it is new, declare it: `{what} {} = CONDITION`",
                spelled(name)
            )
        }
        _ if what.starts_with("behaviour") => {
            format!(
                "if it is new, declare it: `behavior {} {{ … }}`",
                spelled(name)
            )
        }
        _ if what == "variable" => {
            format!("what is kept for this moment is `let {0} = …`, between ticks `local {0} = …`", spelled(name))
        }
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::{DRIVING, SHARED};
    use crate::source::FileId;
    use crate::syntax::ast::ItemKind;
    use crate::syntax::parse;

    #[test]
    fn the_list_is_that_of_the_library() {
        let (file, _) = parse(FileId(0), include_str!("../../library/std.bt"));
        let behaviors = file.items.iter().filter_map(|item| match &item.kind {
            ItemKind::Behavior(behavior) => Some(behavior.name.name.as_str()),
            _ => None,
        });
        assert_eq!(behaviors.collect::<Vec<_>>(), DRIVING);
        let shared = file.items.iter().filter_map(|item| match &item.kind {
            ItemKind::Let(shared) => Some(shared.name.name.as_str()),
            _ => None,
        });
        assert_eq!(shared.collect::<Vec<_>>(), SHARED);
    }
}
