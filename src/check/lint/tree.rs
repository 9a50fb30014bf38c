//! Nodes that a tree never gets to, and guards that ask nothing.
//!
//! Within a tick predicates do not change: a node is reached where all that stands before it gives way. What drives and
//! fails gives way, too, so only what can never fail shuts off what follows it in a selector.

use super::cases::{About, Cases, Says, conjuncts, entry, of_expr, of_guard};
use super::idle::is_switch;
use super::mentions::Mentions;
use super::ranges::NEVER_DRAWN;
use super::repaid::lasts;
use super::view::View;
use crate::check::Checker;
use crate::diagnostic::Code;
use crate::ir::expr::{Expr, ExprId};
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Composite, Decorator, Guard, Node, Status};
use crate::ir::{Id, Name, Program};
use crate::source::Span;
use crate::syntax::ast::{self, ExprKind, Item, ItemKind, NodeKind};
use crate::syntax::print;

impl<'a> Checker<'a> {
    /// Warns of nodes that are never reached and of guards that always or never hold.
    pub fn nodes_without_effect(&mut self, items: impl Iterator<Item = &'a Item> + Clone) {
        let mut of_trees = Mentions::default();
        let is_tree = |item: &&Item| matches!(item.kind, ItemKind::Tree(_));
        items
            .clone()
            .filter(is_tree)
            .for_each(|item| of_trees.item(item));
        let pins = |item: &Item| matches!(&item.kind, ItemKind::Use(it) if it.pin.is_some());
        self.recorded = items.clone().any(pins);
        for item in items {
            let ItemKind::Tree(tree) = &item.kind else {
                continue;
            };
            let name = Name::word(&tree.name.name);
            if let Some(id) = self.program.trees.named(&name) {
                let root = self.program.trees[id].root.clone();
                let always = Cases::constant(true);
                self.drives_nothing(tree, &root, &of_trees);
                self.nodes_of(&tree.root, &root, &always, &always);
            }
        }
    }

    /// `reached` says when the node may be reached, `held` what has been asked by then.
    pub fn nodes_of(&mut self, written: &'a ast::Node, node: &Node, reached: &Cases, held: &Cases) {
        match (&written.kind, node) {
            (NodeKind::Guarded { guard, node: inner }, Node::Composite { children, .. }) => {
                let [Node::Condition(asked), node] = children.as_slice() else {
                    return;
                };
                if self.asks_nothing(guard, asked) {
                    return;
                }
                let within = reached.and(&of_guard(&self.program, asked, true));
                if within.is_never() {
                    let here = held.and(&of_guard(&self.program, asked, true));
                    let why = match here.is_never() {
                        true => "what stands around it rules this out",
                        false => "what comes before it takes every case in which this holds",
                    };
                    self.warning(Code::W0602, guard.span, "this unit is never reached")
                        .label(why);
                    return;
                }
                self.asked_already(guard, asked, held);
                self.parts_of_guard(guard, asked);
                let held = held.and(&of_guard(&self.program, asked, true));
                self.nodes_of(inner, node, &within, &held);
            }
            (NodeKind::Leaf(expr), Node::Behavior(id)) => {
                self.fails_where_it_stands(expr.span, *id, held);
            }
            (NodeKind::Leaf(expr), Node::Condition(asked)) => {
                let literal = matches!(expr.kind, ExprKind::Bool(_));
                if !literal && !self.asks_nothing(expr, asked) {
                    self.asked_already(expr, asked, held);
                }
            }
            (NodeKind::Composite { word, children, .. }, Node::Decorator { kind, child }) => {
                if let [only] = children.as_slice() {
                    self.decorates_nothing(word.span, *kind, child);
                    self.nodes_of(only, child, reached, held);
                }
            }
            (
                NodeKind::Composite { children, .. },
                Node::Parallel {
                    children: nodes, ..
                },
            ) => {
                for (written, node) in children.iter().zip(nodes) {
                    self.nodes_of(written, node, reached, held);
                }
            }
            (
                NodeKind::Composite { children, .. },
                Node::Composite {
                    kind,
                    memory,
                    children: nodes,
                },
            ) => self.children_of((children, nodes), *kind, *memory, (reached, held)),
            _ => {}
        }
    }

    fn children_of(
        &mut self,
        (written, nodes): (&'a [ast::Node], &[Node]),
        kind: Composite,
        memory: bool,
        (reached, held): (&Cases, &Cases),
    ) {
        let (mut open, mut held) = (reached.clone(), held.clone());
        let mut shut: Option<Span> = None;
        for (at, (child, node)) in written.iter().zip(nodes).enumerate() {
            if open.is_never() {
                let (message, label) = match kind {
                    Composite::Selector => ("this is never reached", "this never fails"),
                    Composite::Sequence => ("this is never reached", "this never succeeds"),
                };
                let at = head(child);
                let draft = self
                    .warning(Code::W0602, at, message)
                    .label("never reached");
                if let Some(shut) = shut {
                    draft.also(shut, label);
                }
                return;
            }
            // Whoever writes `false` has the rest switched off on purpose.
            if is_switch(child) {
                return;
            }
            if memory || !self.stands_twice(written, nodes, at) {
                self.nodes_of(child, node, &open, &held);
            }
            // What follows from a constant predicate is told by the warning of that.
            let asked = match (&child.kind, node) {
                (_, Node::Condition(guard)) => Some(guard),
                (NodeKind::Guarded { .. }, Node::Composite { children, .. }) => {
                    match children.first() {
                        Some(Node::Condition(guard)) => Some(guard),
                        _ => None,
                    }
                }
                _ => None,
            };
            if asked.is_some_and(|guard| self.asks_a_constant(guard)) {
                return;
            }
            let status = match kind {
                Composite::Selector => Status::Failure,
                Composite::Sequence => Status::Success,
            };
            let passes = when(&self.program, node, status);
            if kind == Composite::Sequence && !memory {
                self.starts_over(written, nodes, at);
            }
            if kind == Composite::Sequence && !memory {
                held = held.and(&passes);
            }
            // A bare condition in a selector has a warning of its own.
            let bare = kind == Composite::Selector && matches!(node, Node::Condition(_));
            if bare && !is_switch(child) && at + 1 < nodes.len() {
                continue;
            }
            let next = match (memory, passes.is_never()) {
                (false, _) => open.and(&passes),
                // A child of a memory node may have ended in an earlier tick.
                (true, true) => Cases::constant(false),
                (true, false) => open.clone(),
            };
            if next.is_never() {
                shut = Some(head(child));
            }
            open = next;
        }
    }

    /// Warns of a behaviour in a sequence without memory that succeeds only where one before it does not.
    fn starts_over(&mut self, written: &'a [ast::Node], nodes: &[Node], at: usize) {
        let Some((Node::Behavior(here), at_here)) = nodes.get(at).zip(written.get(at)) else {
            return;
        };
        let program = &self.program;
        let succeeds = where_it_succeeds(program, *here);
        let mut before = nodes.iter().zip(written).take(at);
        let apart = before.find_map(|(node, written)| match node {
            Node::Behavior(id) => {
                let both = where_it_succeeds(program, *id).and(&succeeds);
                both.is_never().then_some((*id, written.span))
            }
            _ => None,
        });
        let Some((first, at_first)) = apart else {
            return;
        };
        let [first, here] = [first, *here].map(|id| program.behaviors[id].name.bare());
        let message = format!("`{first}` and `{here}` never succeed in the same tick");
        let label = format!("on its way here the robot leaves where `{first}` succeeds");
        self.warning(Code::W0608, at_here.span, message)
            .label(label)
            .also(
                at_first,
                "then this drives again, and the sequence never succeeds",
            )
            .help("in a `memory sequence` what has succeeded is not ticked again");
    }

    /// Whether a guard always or never holds; warned of if so.
    fn asks_nothing(&mut self, written: &'a ast::Expr, guard: &Guard) -> bool {
        let never = |program: &Program, wanted| of_guard(program, guard, wanted).is_never();
        let (says, wanted) = match [true, false].map(|wanted| never(&self.program, wanted)) {
            [true, _] => ("never", true),
            [_, true] => ("always", false),
            _ => return false,
        };
        // A predicate that is constant by its definition has its warning there.
        let plain = matches!(&written.kind, ExprKind::Ref(_));
        if !plain && !self.asks_a_constant(guard) && !self.says_one_thing_twice(written.span) {
            let asked = self.asked_by(guard);
            let cause = self.cause(&asked, &|program| never(program, wanted));
            if !self.has_told(cause, written.span, &format!("{says} holds")) {
                let why = match wanted {
                    true => self.never_at_once(written, guard),
                    false => "it asks nothing".to_owned(),
                };
                let mut ends = 0;
                guard.visit_atoms(&mut |atom| {
                    ends += usize::from(entry(&self.program, atom).is_some())
                });
                let of_one_end = ends > 1 && says == "never";
                let one_end = "`history last 1` keeps a single end: no two of these hold at once";
                let message = format!("this guard {says} holds");
                self.warning(Code::W0601, written.span, message)
                    .label(why)
                    .help_if(of_one_end.then(|| one_end.to_owned()));
                self.tells(cause);
            }
        }
        true
    }
}

impl Checker<'_> {
    /// Which two parts of a guard that never holds exclude each other, if two do.
    fn never_at_once(&self, written: &ast::Expr, guard: &Guard) -> String {
        let texts = written.conjuncts();
        let parts = match guard {
            Guard::And(parts) if parts.len() == texts.len() => parts.as_slice(),
            _ => &[],
        };
        for (at, other) in parts.iter().enumerate() {
            for (before, one) in parts.iter().take(at).enumerate() {
                let both = Guard::And(vec![one.clone(), other.clone()]);
                if let (true, Some(one), Some(other)) = (
                    of_guard(&self.program, &both, true).is_never(),
                    texts.get(before),
                    texts.get(at),
                ) {
                    let [one, other] = [one, other].map(|text| print::expr(text));
                    return format!("`{one}` and `{other}` never hold at once");
                }
            }
        }
        "whatever happens in the world".to_owned()
    }

    /// Whether a guard asks a predicate that is constant by its definition.
    fn asks_a_constant(&self, guard: &Guard) -> bool {
        let mut any = false;
        guard.visit_atoms(&mut |atom| {
            if let Atom::Predicate(id) = atom {
                any |= self
                    .constant
                    .contains(&self.program.predicates[id].name.family);
            }
        });
        any
    }

    /// Warns of a behaviour that requires what never holds where `held` does. Of a tree that was learned and stands beside its
    /// record it was told as it was learned.
    fn fails_where_it_stands(&mut self, at: Span, id: Id<Behavior>, held: &Cases) {
        let program = &self.program;
        let behavior = &program.behaviors[id];
        let Some(law) = &behavior.law else {
            return;
        };
        let allowed = of_expr(View::of_behavior(program, behavior), law.requires, true);
        if self.recorded || allowed.is_never() || held.is_never() || !held.and(&allowed).is_never()
        {
            return;
        }
        // So it does where it never succeeds at all, which is told of it.
        let named = self.names.value(&behavior.name.family, false);
        let body = named.and_then(|(decl, _)| decl.body());
        if body.is_some_and(|body| self.is_told_within(Code::W0302, body)) {
            return;
        }
        let message = format!("`{}` always fails here", behavior.name.bare());
        self.warning(Code::W0302, at, message)
            .label("what it requires never holds where what stands around it does");
    }
}

/// When a node may answer with success, or with failure.
pub fn when(program: &Program, node: &Node, status: Status) -> Cases {
    let fails = status == Status::Failure;
    let possible = |possible| match possible {
        true => Cases::Unknown,
        false => Cases::constant(false),
    };
    match node {
        Node::Condition(guard) => of_guard(program, guard, !fails),
        Node::Behavior(id) if !program.may_end(*id, status) => Cases::constant(false),
        Node::Behavior(_) if fails => Cases::Unknown,
        Node::Behavior(id) => where_it_succeeds(program, *id),
        Node::Composite {
            kind,
            memory,
            children,
        } => {
            let parts = children.iter().map(|child| when(program, child, status));
            // A sequence succeeds with all of its children, and fails with one.
            let all = (*kind == Composite::Sequence) != fails;
            if *memory {
                let mut parts = parts;
                let never = match all {
                    true => parts.any(|part| part.is_never()),
                    false => parts.all(|part| part.is_never()),
                };
                return possible(!never);
            }
            parts.fold(Cases::constant(all), |so_far, part| match all {
                true => so_far.and(&part),
                false => so_far.or(&part),
            })
        }
        Node::Decorator { kind, child } => match (kind, status) {
            (Decorator::Succeed, Status::Failure) | (Decorator::Fail, Status::Success) => {
                Cases::constant(false)
            }
            (Decorator::Retry(_) | Decorator::Repeat(_), _)
            | (Decorator::Timeout(_), Status::Success) => {
                possible(!when(program, child, status).is_never())
            }
            _ => Cases::Unknown,
        },
        Node::Parallel { .. } => Cases::Unknown,
    }
}

/// Where the robot is when a condition holds that waits for the success of behaviours: a step away from where they succeed, at
/// most.
pub fn at_success(program: &Program, id: ExprId) -> Cases {
    let Some(world) = &program.world else {
        return Cases::constant(true);
    };
    let drive = &world.robot.drive;
    let step = (drive.max_speed + NEVER_DRAWN * drive.speed_noise) * world.tick;
    let mut places = as_it_succeeds(program, id);
    if let Cases::Some(cases) = &mut places {
        for case in cases {
            case.retain(|about, says| match (about, says) {
                (About::At(_), Says::Within(within)) => {
                    *within = within.wider(step);
                    true
                }
                _ => false,
            });
        }
    }
    places
}

/// The same, as the robot stands when they succeed.
pub fn as_it_succeeds(program: &Program, id: ExprId) -> Cases {
    let own = conjuncts(program, id).into_iter().filter_map(|id| {
        let Expr::Ended(behavior, Status::Success) = program.pool.get(id) else {
            return None;
        };
        let is_own = program.behaviors[behavior].name.robot().is_none();
        is_own.then(|| where_it_succeeds(program, behavior))
    });
    own.fold(Cases::constant(true), |all, places| all.and(&places))
}

/// Where a behaviour may succeed, as far as that hangs on nothing but where the robot is.
fn where_it_succeeds(program: &Program, id: Id<Behavior>) -> Cases {
    let behavior = &program.behaviors[id];
    let Some(law) = &behavior.law else {
        return Cases::Unknown;
    };
    let view = View::of_behavior(program, behavior);
    let [allowed, succeeds] = [law.requires, law.succeed].map(|id| of_expr(view, id, true));
    let both = match (&allowed, &succeeds) {
        (Cases::Unknown, _) => succeeds,
        (_, Cases::Unknown) => allowed,
        _ => allowed.and(&succeeds),
    };
    let Cases::Some(mut cases) = both else {
        return both;
    };
    // What it waits for never holds: that is told where it is declared.
    if cases.is_empty() {
        return Cases::Unknown;
    }
    for case in &mut cases {
        case.retain(|about, _| match about {
            About::At(_) => true,
            About::Truth(id) | About::Number(id) => lasts(program, *id),
            About::Atom(_) | About::Ended(_) | About::Last => false,
        });
    }
    Cases::Some(cases)
}

/// The part of a node to point at: its guard, or the word that it begins with.
fn head(node: &ast::Node) -> Span {
    match &node.kind {
        NodeKind::Composite { word, .. } => word.span,
        NodeKind::Guarded { guard, .. } => guard.span,
        NodeKind::Leaf(_) | NodeKind::Error => node.span,
    }
}
