//! A tree whose text has moved.

use super::{
    Answer, Arg, ArgKind, Aspect, AspectKind, AssignOp, Axis, Behavior, BehaviorBody, BinaryOp,
    Binding, Block, Branch, Choice, Claim, ClaimWhat, Clause, ClauseKind, Else, Enum, Event, Expr,
    ExprKind, Field, Ident, Input, InputKind, Item, ItemKind, Learn, LearnEntry, Let, LetBody,
    Link, Literal, Node, NodeKind, On, Otherwise, Outcome, Paid, Param, Params, Predicate, Ref,
    RewardLine, RobotEntry, RobotEntryKind, Setting, Spanned, Start, StartLine, State, Step, Stmt,
    StmtKind, Task, Test, TestLine, TestLineKind, Tree, Trigger, TypeExpr, UnaryOp, Unit,
    UnitFactor, Use, UseWhat, Word, World, WorldEntry, WorldEntryKind, Yield,
};
use crate::source::Span;

/// What has places in a text.
pub(in crate::syntax) trait Shift {
    /// Moves all places by so many bytes.
    fn shift(&mut self, by: i64);
}

impl Shift for Span {
    fn shift(&mut self, by: i64) {
        let moved = |at: u32| u32::try_from(i64::from(at) + by).unwrap_or(u32::MAX);
        self.start = moved(self.start);
        self.end = moved(self.end);
    }
}

impl<T: Shift> Shift for Vec<T> {
    fn shift(&mut self, by: i64) {
        self.iter_mut().for_each(|part| part.shift(by));
    }
}

impl<T: Shift> Shift for Option<T> {
    fn shift(&mut self, by: i64) {
        self.iter_mut().for_each(|part| part.shift(by));
    }
}

impl<T: Shift> Shift for Box<T> {
    fn shift(&mut self, by: i64) {
        self.as_mut().shift(by);
    }
}

impl<T: Shift, U: Shift> Shift for (T, U) {
    fn shift(&mut self, by: i64) {
        self.0.shift(by);
        self.1.shift(by);
    }
}

impl<T: Shift> Shift for Spanned<T> {
    fn shift(&mut self, by: i64) {
        self.node.shift(by);
        self.span.shift(by);
    }
}

/// What stands in a tree and has no place.
macro_rules! placeless {
    ($($of:ident),*) => {
        $(impl Shift for $of {
            fn shift(&mut self, _: i64) {}
        })*
    };
}

/// What has places in its fields, all of which are named here.
macro_rules! fields {
    ($($of:ident { $($field:ident),* })*) => {
        $(impl Shift for $of {
            fn shift(&mut self, by: i64) {
                let Self { $($field),* } = self;
                $($field.shift(by);)*
            }
        })*
    };
}

/// What has places in its variants.
macro_rules! variants {
    ($($of:ident {
        $($variant:ident $(($($part:ident),*))? $({ $($field:ident),* })?),*
    })*) => {
        $(impl Shift for $of {
            fn shift(&mut self, by: i64) {
                match self {
                    $(Self::$variant $(($($part),*))? $({ $($field),* })? => {
                        $($($part.shift(by);)*)?
                        $($($field.shift(by);)*)?
                    })*
                }
            }
        })*
    };
}

placeless!(
    String, bool, f64, Answer, AssignOp, Axis, BinaryOp, Link, Outcome, UnaryOp, UnitFactor,
    UseWhat, Word
);

fields! {
    Ident { name, span }
    Item { docs, kind, span }
    Use { what, pin }
    Enum { name, variants }
    Input { name, kind }
    State { name, params, ty, value }
    Event { name, params, value }
    On { trigger, block }
    Let { name, params, ty, body }
    Predicate { name, params, value }
    Params { params, span }
    Param { name, ty, default, span }
    TypeExpr { factors, span }
    World { name, entries }
    WorldEntry { docs, kind, span }
    RobotEntry { docs, kind, span }
    Field { name, value }
    Behavior { name, params, body }
    Clause { kind, span }
    Block { stmts, span }
    Stmt { kind, span }
    Binding { name, ty, value, span }
    Branch { cond, then, otherwise }
    Task { name, aspects }
    Aspect { kind, span }
    Start { lines, span }
    StartLine { target, value, span }
    RewardLine { paid, value, span }
    Learn { name, task, entries }
    Setting { name, value, tail, span }
    Tree { name, params, task, root }
    Node { kind, span }
    Claim { tree, what, within, probability }
    Test { title, tree, lines }
    TestLine { kind, span }
    Step { name, answer }
    Expr { kind, span }
    Literal { digits, value, unit }
    Unit { text, factors, span }
    Ref { name, args, span }
    Arg { kind, span }
    Choice { cond, then, otherwise }
    Yield { bindings, value, span }
}

variants! {
    ItemKind {
        Use(it), World(it), Enum(it), State(it), Input(it), Event(it), EachTick(it), On(it),
        Let(it), Predicate(it), Behavior(it), Task(it), Learn(it), Tree(it), Claim(it), Test(it),
        Error
    }
    InputKind { Number(ty), Category(values) }
    Trigger { Expr(expr), Family { name, params } }
    LetBody { Expr(expr), Yield(body) }
    WorldEntryKind {
        Place { name, of_kind, shape, facing }, Wall { name, of_kind, shape, when },
        Robot { name, entries }, Field(field), Error
    }
    RobotEntryKind { Sensor { name, value }, Field(field), Error }
    BehaviorBody { Declared, Alias(of), Clauses(clauses) }
    ClauseKind {
        Local { name, ty, value }, Requires(expr), Succeed(expr), Fail(expr), Control(block), Error
    }
    StmtKind {
        Let(binding), For { name, domain, block }, Branch(branch), Assign { target, op, value },
        Call(call), Error
    }
    Else { If(branch), Block(block) }
    AspectKind {
        Observe(list), Choose(list), History { window, outcomes }, Patience(time), Start(start),
        EndOn(event), EndAfter(time), Reward { lines, otherwise }, Error
    }
    Paid { On(event), Per { during, time } }
    LearnEntry { Start(start), Setting(setting), Error(span) }
    NodeKind {
        Composite { memory, word, args, children }, Guarded { guard, node }, Leaf(expr), Error
    }
    ClaimWhat { Equals(name), Never(event), Reaches(event) }
    TestLineKind { Given(changes), Tick { changes, lasting, steps }, Error }
    ExprKind {
        Number(literal), Bool(value), Ref(reference), If(choice), Point(x, y), Paren(inner),
        Coordinate(of, axis), Unary { op, operand }, Binary { op, left, right }, Error
    }
    ArgKind {
        Positional(expr), Named(name, expr), Range(low, high), Binder { name, domain, body, member }
    }
    Otherwise { If(choice, span), Yield(body) }
}
