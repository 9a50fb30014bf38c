//! Timeouts of trees that are asked for where no world counts ticks.

use crate::check::Checker;
use crate::check::expr::plain_ref;
use crate::check::names::Decl;
use crate::diagnostic::Diagnostic;
use crate::source::Span;
use crate::syntax::ast::{self, ArgKind, Node, NodeKind, Word};

impl<'a> Checker<'a> {
    /// Reports the timeouts of a tree that a claim or a test needs, if no world says how long their times are. A file
    /// without a world may leave that to the one that uses it, but what it claims and tests itself is known here.
    pub(super) fn needs_ticks(&mut self, tree: &'a ast::Tree, asked: Span) {
        if self.has_world {
            return;
        }
        let mut times = Vec::new();
        self.timeouts_of(tree, &mut vec![tree.name.span], &mut times);
        for time in times {
            let told = |found: &Diagnostic| found.is_error() && found.span() == time;
            if !self.diagnostics.iter().any(told) {
                self.no_world(time, "a timeout", "how many ticks are these?")
                    .also(asked, "they are counted for this");
            }
        }
    }

    /// The times of the timeouts in a tree and its subtrees.
    fn timeouts_of(&self, tree: &'a ast::Tree, seen: &mut Vec<Span>, times: &mut Vec<Span>) {
        let mut nodes: Vec<&'a Node> = vec![&tree.root];
        while let Some(node) = nodes.pop() {
            match &node.kind {
                NodeKind::Composite {
                    word,
                    args,
                    children,
                    ..
                } => {
                    let arg = args.as_deref().and_then(<[ast::Arg]>::first);
                    if word.node == Word::Timeout
                        && let Some(ArgKind::Positional(time)) = arg.map(|arg| &arg.kind)
                    {
                        times.push(time.span);
                    }
                    nodes.extend(children);
                }
                NodeKind::Guarded { node, .. } => nodes.push(node),
                NodeKind::Leaf(leaf) => {
                    let name = plain_ref(leaf).map(|leaf| leaf.name.name.as_str());
                    let named = name.and_then(|name| self.names.value(name, false));
                    if let Some((Decl::Tree(subtree), _)) = named
                        && !seen.contains(&subtree.name.span)
                    {
                        seen.push(subtree.name.span);
                        self.timeouts_of(subtree, seen, times);
                    }
                }
                NodeKind::Error => {}
            }
        }
    }
}
