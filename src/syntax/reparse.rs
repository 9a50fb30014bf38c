//! A text that has changed: its tree, made of the tree that it had before.
//!
//! Items whose text and whose neighbours' texts are what they were are taken over. All others are parsed again, and so
//! is what was not understood.

use super::ast::shift::Shift;
use super::ast::{Comment, File, Item, ItemKind};
use super::build::Builder;
use super::grammar::{self, Node, Rule};
use super::tokens::{Kind, Token};
use crate::diagnostic::Diagnostic;
use crate::source::FileId;
use std::ops::Range;

/// A text with the items that were read in it.
pub(super) struct Read {
    file: FileId,
    text: String,
    items: Vec<Item>,
    /// For each item, and before them for what stands above the first one: whether it was understood without a word.
    clean: Vec<bool>,
}

/// A text that is to be read, cut into tokens.
pub(super) struct Unread<'i> {
    /// The file.
    pub(super) file: FileId,
    /// Its text.
    pub(super) text: &'i str,
    /// The tokens of the text.
    pub(super) tokens: &'i [Token],
    /// The comments among them.
    pub(super) comments: &'i [Comment],
}

impl<'i> Unread<'i> {
    fn builder(&self) -> Builder<'i> {
        Builder::new(self.file, self.text, self.tokens, self.comments)
    }

    /// The tree of the text and what is wrong with it; else the byte at which the parser gave up.
    pub(super) fn read(&self) -> Result<(File, Vec<Diagnostic>), usize> {
        let mut builder = self.builder();
        let nodes = grammar::parse(Rule::file, self.text).map_err(|stop| stop.at)?;
        let items = builder.items(0, nodes.flat_map(Node::into_inner), None);
        Ok(builder.file(items))
    }

    /// The same, with what can be taken over from the text before. `None` if nothing can.
    pub(super) fn read_again(&self, before: &Read) -> Option<(File, Vec<Diagnostic>)> {
        let change = Change::between(before, self)?;
        let kept = before.kept(&change);
        if !kept.contains(&true) {
            return None;
        }
        let mut builder = self.builder();
        let mut items: Vec<Item> = Vec::with_capacity(before.items.len());
        let mut region = 0;
        while let Some(keeps) = kept.get(region) {
            if *keeps {
                items.extend(before.item(region).map(|item| change.moved(item)));
                region += 1;
                continue;
            }
            region = self.read_regions(before, &change, &kept, region, &mut builder, &mut items)?;
        }
        Some(builder.file(items))
    }

    /// Whether the parser, which looks for the `}` of a block that is not closed, finds none behind byte `at`: each has a
    /// partner there, without a line between them that could begin an item.
    fn is_paired_behind(&self, at: usize) -> bool {
        let first = self.tokens.partition_point(|token| token.start < at);
        let mut open = 0_usize;
        for token in self.tokens.iter().skip(first) {
            let before = self.text.get(..token.start).unwrap_or_default();
            match token.of(self.text) {
                _ if open > 0 && token.kind == Kind::Word && before.ends_with('\n') => {
                    return false;
                }
                "{" => open += 1,
                "}" => match open.checked_sub(1) {
                    Some(rest) => open = rest,
                    None => return false,
                },
                _ => {}
            }
        }
        open == 0
    }

    /// Reads the regions from one on up to the next that can be taken over, whose index is given back.
    fn read_regions(
        &self,
        before: &Read,
        change: &Change,
        kept: &[bool],
        first: usize,
        builder: &mut Builder<'i>,
        items: &mut Vec<Item>,
    ) -> Option<usize> {
        let start = match first {
            0 => 0,
            _ => change.now(before.start(first)),
        };
        let mut next = first;
        let mut reach = 1;
        loop {
            next += reach;
            reach *= 2;
            next += kept.iter().skip(next).take_while(|keeps| !**keeps).count();
            // The parser sees what follows, as it would in the whole text. How far it looks for the `}` of a block is
            // bounded only by brackets that have no partner.
            let seen = match self.is_paired_behind(change.now(before.start(next))) {
                true => change.now(before.start(next + 2)),
                false => self.text.len(),
            };
            let nodes = grammar::parse(Rule::file, self.text.get(start..seen)?).ok()?;
            let nodes: Vec<Node> = nodes.flat_map(Node::into_inner).collect();
            let Some(item) = before.item(next) else {
                items.extend(builder.items(start, nodes, items.last().map(|item| item.span)));
                return Some(next);
            };
            let at = change.now(item.span.start as usize) - start;
            let is_same = |node: &Node| node.as_span().start() == at && is_item(node.as_rule());
            if let Some(end) = nodes.iter().position(is_same) {
                let nodes = nodes.into_iter().take(end);
                items.extend(builder.items(start, nodes, items.last().map(|item| item.span)));
                return Some(next);
            }
        }
    }
}

impl Read {
    /// What is to be known of a text that was read.
    pub(super) fn new(text: String, tree: &File, found: &[Diagnostic]) -> Self {
        let items = tree.items.clone();
        let understood = items.iter().map(|item| item.kind != ItemKind::Error);
        let mut clean: Vec<bool> = std::iter::once(true).chain(understood).collect();
        // One message may stand for several places.
        let places = found.iter().flat_map(|found| {
            let labels = found.labels.iter().map(|label| label.span);
            let edits = found.fixes.iter().flat_map(|fix| &fix.edits);
            labels.chain(edits.map(|(span, _)| *span))
        });
        for at in places {
            let first = items.partition_point(|item| item.span.start < at.start);
            let last = items.partition_point(|item| item.span.start <= at.end);
            let touched = clean.get_mut(first..=last);
            touched.unwrap_or_default().fill(false);
        }
        Self {
            file: tree.span.file,
            text,
            items,
            clean,
        }
    }

    /// The item of a region.
    fn item(&self, region: usize) -> Option<&Item> {
        self.items.get(region.checked_sub(1)?)
    }

    /// Where a region begins: an item with what follows it up to the next one. The first region has no item.
    fn start(&self, region: usize) -> usize {
        match region {
            0 => 0,
            _ => self
                .item(region)
                .map_or(self.text.len(), |item| item.span.start as usize),
        }
    }

    /// The regions that can be taken over: they and those beside them were understood and are what they were.
    fn kept(&self, change: &Change) -> Vec<bool> {
        let same = self.clean.iter().enumerate().map(|(index, clean)| {
            *clean && change.spares(&(self.start(index)..self.start(index + 1)))
        });
        let same: Vec<bool> = same.collect();
        let beside = |index: usize| same.get(index).copied().unwrap_or(true);
        let kept = same.iter().enumerate().map(|(index, same)| {
            *same && beside(index + 1) && index.checked_sub(1).is_none_or(beside)
        });
        kept.collect()
    }
}

/// Whether a production is an item that was understood.
fn is_item(rule: Rule) -> bool {
    !matches!(
        rule,
        Rule::bad_item | Rule::stray_mark | Rule::stray_close | Rule::EOI
    )
}

/// What has changed between two texts: one run of bytes.
struct Change {
    /// The run in the text before.
    old: Range<usize>,
    /// By how many bytes what follows it has moved.
    by: i64,
}

impl Change {
    /// `None` if the texts are of different files.
    fn between(before: &Read, now: &Unread) -> Option<Self> {
        let (old, new) = (before.text.as_bytes(), now.text.as_bytes());
        let equal = |(one, other): &(&u8, &u8)| one == other;
        let prefix = old.iter().zip(new).take_while(equal).count();
        let most = old.len().min(new.len()) - prefix;
        let ends = old.iter().rev().zip(new.iter().rev());
        let suffix = ends.take(most).take_while(equal).count();
        let length = |bytes: &[u8]| i64::try_from(bytes.len()).ok();
        (before.file == now.file).then_some(Self {
            old: prefix..old.len() - suffix,
            by: length(new)? - length(old)?,
        })
    }

    /// Whether a part of the text before is what it was.
    fn spares(&self, part: &Range<usize>) -> bool {
        let nothing = self.by == 0 && self.old.is_empty();
        nothing || part.end < self.old.start || part.start > self.old.end
    }

    /// Where a byte of the text before stands now that is not in what has changed.
    fn now(&self, at: usize) -> usize {
        match at < self.old.start {
            true => at,
            false => at.saturating_add_signed(isize::try_from(self.by).unwrap_or(0)),
        }
    }

    /// An item of the text before that is not in what has changed.
    fn moved(&self, item: &Item) -> Item {
        let mut item = item.clone();
        let at = item.span.start as usize;
        if self.by != 0 && at >= self.old.start {
            item.shift(self.by);
        }
        item
    }
}
