//! Trees in the language: a syntax tree is made of the IR, and the formatter prints it.
//!
//! What is made here stands in no file, so its spans are empty.

use crate::ir::input::InputKind;
use crate::ir::name::{Given, Name};
use crate::ir::program::Predicate;
use crate::ir::tree::{Composite, Decorator, Guard, Node, Tree};
use crate::ir::{Id, Program};
use crate::source::Span;
use crate::syntax::ast::{
    self, Arg, ArgKind, BehaviorBody, BinaryOp, Expr, ExprKind, Ident, Item, ItemKind, Literal,
    NodeKind, Ref, Spanned, UnaryOp, Unit, Word, chain,
};
use crate::syntax::print;
use crate::tree::unit::parts;

/// A tree as an item of the language, with its documentation.
pub fn tree(program: &Program, tree: &Tree) -> String {
    print::item(&tree_item(program, tree))
}

/// What is printed of a predicate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Definition {
    /// Its name alone.
    None,
    /// Nothing.
    Unused,
    /// That an input is at most a number in a unit, which may be empty.
    AtMost {
        /// The input.
        name: String,
        /// The number, perhaps with a sign.
        number: String,
        /// The unit.
        unit: String,
    },
    /// That an input has a value.
    Is {
        /// The input.
        name: String,
        /// The value.
        value: String,
    },
}

/// A program of declared names and its trees as a file, with a `//!` line each of `docs`.
pub fn declared(program: &Program, docs: &[String]) -> String {
    defined(program, |_| Definition::None, docs)
}

/// A program of inputs, of names that are declared or defined, and of its trees as a file.
pub fn defined(
    program: &Program,
    definition: impl Fn(Id<Predicate>) -> Definition,
    docs: &[String],
) -> String {
    let inputs = program.inputs.values().map(|input| {
        item(ItemKind::Input(ast::Input {
            name: ident(&input.name.bare()),
            kind: kind(&input.kind),
        }))
    });
    let predicates = program.predicates.iter().filter_map(|(id, predicate)| {
        let definition = definition(id);
        if definition == Definition::Unused {
            return None;
        }
        let value = asked(&definition);
        Some(item(ItemKind::Predicate(ast::Predicate {
            name: ident(&predicate.name.bare()),
            params: None,
            value,
        })))
    });
    let behaviors = program.behaviors.values().map(|behavior| {
        item(ItemKind::Behavior(ast::Behavior {
            name: ident(&behavior.name.bare()),
            params: None,
            body: BehaviorBody::Declared,
        }))
    });
    let trees = program.trees.values().map(|tree| tree_item(program, tree));
    let file = ast::File {
        items: inputs
            .chain(predicates)
            .chain(behaviors)
            .chain(trees)
            .collect(),
        ..ast::File::default()
    };
    let docs: String = docs.iter().map(|line| format!("//! {line}\n")).collect();
    format!("{docs}\n{}", print::file(&file, None))
}

/// What a predicate asks by its definition, on one line; `None` where its name alone is printed, or nothing.
pub fn meaning(definition: &Definition) -> Option<String> {
    asked(definition).map(|value| print::expr(&value))
}

fn asked(definition: &Definition) -> Option<Expr> {
    match definition {
        Definition::Unused | Definition::None => None,
        Definition::AtMost { name, number, unit } => {
            let unit = Some(unit.as_str()).filter(|unit| !unit.is_empty());
            let number = match number.strip_prefix('-') {
                None => literal(number, unit),
                Some(number) => expr(ExprKind::Unary {
                    op: spanned(UnaryOp::Neg),
                    operand: Box::new(literal(number, unit)),
                }),
            };
            Some(compared(name, BinaryOp::Le, number))
        }
        Definition::Is { name, value } => Some(compared(
            name,
            BinaryOp::Eq,
            reference(&Name::word(value.clone())),
        )),
    }
}

/// What an input may be.
fn kind(kind: &InputKind) -> ast::InputKind {
    match kind {
        InputKind::Number { dim, ratio } => {
            let written = match ratio {
                true => "ratio".to_owned(),
                false => dim.written(),
            };
            let mut divides = false;
            let mut factors = Vec::new();
            for name in written.split_inclusive(['*', '/']) {
                factors.push((ident(name.trim_end_matches(['*', '/'])), divides));
                divides = name.ends_with('/');
            }
            ast::InputKind::Number(ast::TypeExpr {
                factors,
                span: Span::default(),
            })
        }
        InputKind::Category(values) => {
            let values = values.iter().map(|value| ident(&value.bare()));
            ast::InputKind::Category(values.collect())
        }
    }
}

/// An input, compared with something.
fn compared(input: &str, op: BinaryOp, with: Expr) -> Expr {
    expr(ExprKind::Binary {
        op: spanned(op),
        left: Box::new(reference(&Name::word(input))),
        right: Box::new(with),
    })
}

/// A guard on one line.
pub fn guard(program: &Program, guard: &Guard) -> String {
    print::expr(&formula(program, guard))
}

fn tree_item(program: &Program, tree: &Tree) -> Item {
    let task = tree.task.map(|task| &program.tasks[task].name);
    Item {
        docs: tree.docs.clone(),
        ..item(ItemKind::Tree(ast::Tree {
            name: ident(&tree.name.bare()),
            params: None,
            task: task.map(|task| ident(&task.bare())),
            root: node(program, &tree.root),
        }))
    }
}

fn item(kind: ItemKind) -> Item {
    Item {
        docs: Vec::new(),
        kind,
        span: Span::default(),
    }
}

fn node(program: &Program, at: &Node) -> ast::Node {
    let kind = match at {
        Node::Condition(guard) => NodeKind::Leaf(formula(program, guard)),
        Node::Behavior(id) => NodeKind::Leaf(reference(&program.behaviors[*id].name)),
        Node::Composite {
            kind,
            memory,
            children,
        } => match parts(at) {
            Some((guard, body)) if !matches!(body, Node::Condition(_)) => NodeKind::Guarded {
                guard: formula(program, guard),
                node: Box::new(node(program, body)),
            },
            _ => {
                let word = match kind {
                    Composite::Selector => Word::Selector,
                    Composite::Sequence => Word::Sequence,
                };
                composite(program, *memory, word, None, children)
            }
        },
        Node::Parallel {
            successes,
            children,
        } => {
            let argument = Some(literal(*successes, None));
            composite(program, false, Word::Parallel, argument, children)
        }
        Node::Decorator { kind, child } => {
            let (word, argument) = match kind {
                Decorator::Invert => (Word::Invert, None),
                Decorator::Succeed => (Word::Succeed, None),
                Decorator::Fail => (Word::Fail, None),
                Decorator::Retry(times) => (Word::Retry, Some(literal(*times, None))),
                Decorator::Repeat(times) => (Word::Repeat, Some(literal(*times, None))),
                Decorator::Timeout(ticks) => (Word::Timeout, Some(literal(*ticks, Some("ticks")))),
            };
            composite(program, false, word, argument, std::slice::from_ref(child))
        }
    };
    ast::Node {
        kind,
        span: Span::default(),
    }
}

fn composite(
    program: &Program,
    memory: bool,
    word: Word,
    argument: Option<Expr>,
    children: &[Node],
) -> NodeKind {
    NodeKind::Composite {
        memory: memory.then(Span::default),
        word: spanned(word),
        args: argument.map(|argument| vec![arg(ArgKind::Positional(argument))]),
        children: children.iter().map(|child| node(program, child)).collect(),
    }
}

fn formula(program: &Program, at: &Guard) -> Expr {
    match at {
        Guard::Const(value) => expr(ExprKind::Bool(*value)),
        Guard::Atom(atom) => reference(&program.atom_name(*atom)),
        Guard::Not(inner) => expr(ExprKind::Unary {
            op: spanned(UnaryOp::Not),
            operand: Box::new(formula(program, inner)),
        }),
        Guard::And(parts) => joined(program, BinaryOp::And, parts),
        Guard::Or(parts) => joined(program, BinaryOp::Or, parts),
    }
}

/// Parts that are themselves joined by `op` need no parentheses, wherever they stand.
fn joined(program: &Program, op: BinaryOp, parts: &[Guard]) -> Expr {
    fn flat<'g>(op: BinaryOp, parts: &'g [Guard], all: &mut Vec<&'g Guard>) {
        for part in parts {
            match (op, part) {
                (BinaryOp::And, Guard::And(inner)) | (BinaryOp::Or, Guard::Or(inner)) => {
                    flat(op, inner, all);
                }
                _ => all.push(part),
            }
        }
    }
    let mut all = Vec::new();
    flat(op, parts, &mut all);
    let parts = all.into_iter().map(|part| formula(program, part));
    let parts: Vec<Expr> = parts.collect();
    let signs = vec![spanned(op); parts.len().saturating_sub(1)];
    chain(parts, signs).unwrap_or_else(|| expr(ExprKind::Bool(op == BinaryOp::And)))
}

/// A name as an expression.
fn reference(name: &Name) -> Expr {
    let args = name.given().map(|(parameter, value)| {
        let value = match value {
            Given::Name(name) => reference(name),
            Given::Text(text) | Given::Tuned { written: text, .. } => literal(text, None),
        };
        arg(match parameter {
            Some(parameter) => ArgKind::Named(ident(parameter), value),
            None => ArgKind::Positional(value),
        })
    });
    let args: Vec<Arg> = args.collect();
    expr(ExprKind::Ref(Ref {
        name: ident(&name.family),
        args: (!args.is_empty()).then_some(args),
        span: Span::default(),
    }))
}

/// Something in a spelling of its own, which the printer keeps.
fn literal(spelling: impl ToString, unit: Option<&str>) -> Expr {
    let digits = spelling.to_string();
    expr(ExprKind::Number(Literal {
        value: digits.parse().unwrap_or_default(),
        digits,
        unit: unit.map(|text| Unit {
            text: text.to_owned(),
            factors: Vec::new(),
            span: Span::default(),
        }),
    }))
}

fn expr(kind: ExprKind) -> Expr {
    Expr {
        kind,
        span: Span::default(),
    }
}

fn arg(kind: ArgKind) -> Arg {
    Arg {
        kind,
        span: Span::default(),
    }
}

fn ident(name: &str) -> Ident {
    Ident {
        name: name.to_owned(),
        span: Span::default(),
    }
}

fn spanned<T>(node: T) -> Spanned<T> {
    Spanned {
        node,
        span: Span::default(),
    }
}
