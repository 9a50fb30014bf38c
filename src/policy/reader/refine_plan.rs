//! Policies of refine-plan in YAML: `state_factors` says what the factors of a state may be, `state_action_map` what is done in
//! each state. A state whose action is `None` says nothing.

use super::decoded;
use crate::ir::input::Measure;
use crate::policy::error::{TableError, TableErrorKind};
use crate::policy::names;
use crate::policy::valued::{Builder, Valued};
use saphyr_parser::{Event, Parser, Span};
use std::collections::BTreeMap;
use std::ops::Range;

/// The deepest nesting of a policy, and some more.
const DEEPEST: usize = 16;

/// The most nodes that stand for aliases.
const MOST: usize = 2_000_000;

/// A node of YAML with its place.
#[derive(Clone)]
struct Node {
    kind: Yaml,
    place: Range<usize>,
}

#[derive(Clone)]
enum Yaml {
    Scalar(String),
    List(Vec<Node>),
    Map(Vec<(Node, Node)>),
}

/// Whether a text is of this kind.
pub(super) fn is_one(text: &[u8]) -> bool {
    let mut lines = text.split(|b| *b == b'\n');
    lines.any(|line| line.starts_with(b"state_action_map:") || line.starts_with(b"state_factors:"))
}

pub(super) fn read(text: &[u8]) -> Result<Valued, Vec<TableError>> {
    let whole = decoded(text)?;
    let document = parsed(whole).map_err(|error| vec![error])?;
    let mut builder = Builder::default();
    let start = document.place.start..document.place.start;
    let (Some(factors), Some(map)) = (
        document.get("state_factors").and_then(Node::entries),
        document.get("state_action_map").and_then(Node::items),
    ) else {
        let missing = match document.get("state_factors") {
            Some(_) => "state_action_map",
            None => "state_factors",
        };
        builder.report(&start, foreign(format!("`{missing}` is missing")));
        return builder.finish(start);
    };
    let mut columns: BTreeMap<&str, usize> = BTreeMap::new();
    for (name, factor) in factors {
        let Some(called) = name.scalar() else {
            continue;
        };
        let kind = factor.get("type").and_then(Node::scalar);
        let values = factor.get("values").and_then(Node::items);
        let own = names::foreign(called);
        let column = match (kind, values) {
            (Some("BoolStateFactor"), _) => builder.truth(&own, &name.place),
            (Some("IntStateFactor"), _) => builder.number(&own, &name.place, Measure::plain()),
            (Some("StateFactor"), Some(values)) => {
                let values = values.iter().filter_map(Node::scalar).map(str::to_owned);
                builder.category(&own, &name.place, values.collect())
            }
            _ => {
                let message = format!(
                    "`{called}` is neither a BoolStateFactor, nor an IntStateFactor, nor a StateFactor with values"
                );
                builder.report(&name.place, foreign(message));
                continue;
            }
        };
        columns.insert(called, column);
    }
    if builder.is_sound() {
        for entry in map {
            if builder.is_full() {
                break;
            }
            row(entry, &columns, &mut builder);
        }
    }
    builder.finish(start)
}

fn row(entry: &Node, columns: &BTreeMap<&str, usize>, builder: &mut Builder) {
    let place = &entry.place;
    let action = entry.get("action").and_then(Node::scalar);
    let (Some(action), Some(fields)) = (action, entry.entries()) else {
        return builder.report(place, TableErrorKind::MissingKey("action".to_owned()));
    };
    if action == "None" {
        return;
    }
    builder.begin();
    for (name, value) in fields {
        let (Some(called), Some(text)) = (name.scalar(), value.scalar()) else {
            let message = "a factor has one value".to_owned();
            builder.report(&value.place, foreign(message));
            continue;
        };
        match columns.get(called) {
            Some(column) => builder.cell(*column, text, &value.place),
            None if called == "action" => {}
            None => {
                let message = format!("`state_factors` has no `{called}`");
                builder.report(&name.place, foreign(message));
            }
        }
    }
    builder.allow([names::foreign(action).as_str()], place);
    builder.end(place.clone());
}

impl Node {
    fn scalar(&self) -> Option<&str> {
        match &self.kind {
            Yaml::Scalar(text) => Some(text),
            _ => None,
        }
    }

    fn items(&self) -> Option<&[Node]> {
        match &self.kind {
            Yaml::List(items) => Some(items),
            _ => None,
        }
    }

    fn entries(&self) -> Option<&[(Node, Node)]> {
        match &self.kind {
            Yaml::Map(entries) => Some(entries),
            _ => None,
        }
    }

    /// How many nodes it has.
    fn size(&self) -> usize {
        match &self.kind {
            Yaml::Scalar(_) => 1,
            Yaml::List(items) => items.iter().map(Self::size).sum::<usize>() + 1,
            Yaml::Map(entries) => {
                let sizes = entries.iter().map(|(key, value)| key.size() + value.size());
                sizes.sum::<usize>() + 1
            }
        }
    }

    fn get(&self, key: &str) -> Option<&Node> {
        let mut entries = self.entries()?.iter();
        let found = entries.find(|(name, _)| name.scalar() == Some(key));
        found.map(|(_, value)| value)
    }
}

/// The document in a text.
fn parsed(text: &str) -> Result<Node, TableError> {
    // Places are counted in characters.
    let places: Vec<usize> = text.char_indices().map(|(at, _)| at).collect();
    let byte = |at: usize| places.get(at).copied().unwrap_or(text.len());
    let place = |span: &Span| byte(span.start.index())..byte(span.end.index());
    let mut open: Vec<(Yaml, usize, Vec<Node>)> = Vec::new();
    // What has been given a name, for the aliases that stand for it.
    let mut named: BTreeMap<usize, Node> = BTreeMap::new();
    let mut names: Vec<usize> = Vec::new();
    let mut copied = 0_usize;
    for event in Parser::new_from_str(text) {
        let (event, span) = event.map_err(|error| {
            let at = byte(error.marker().index());
            TableError {
                span: at..(at + 1).min(text.len()),
                kind: TableErrorKind::Malformed(error.info().to_owned()),
            }
        })?;
        let place = place(&span);
        let node = match event {
            Event::SequenceStart(name, ..) => {
                names.push(name);
                open.push((Yaml::List(Vec::new()), place.start, Vec::new()));
                None
            }
            Event::MappingStart(name, ..) => {
                names.push(name);
                open.push((Yaml::Map(Vec::new()), place.start, Vec::new()));
                None
            }
            Event::SequenceEnd | Event::MappingEnd => {
                let node = open
                    .pop()
                    .map(|(kind, start, nodes)| closed(kind, start, nodes));
                let name = names.pop().filter(|name| *name > 0);
                named.extend(name.zip(node.clone()));
                node
            }
            Event::Scalar(value, _, name, _) => {
                let node = Node {
                    kind: Yaml::Scalar(value.into_owned()),
                    place,
                };
                named.extend((name > 0).then(|| (name, node.clone())));
                Some(node)
            }
            Event::Alias(name) => {
                let node = named.get(&name);
                copied = copied.saturating_add(node.map_or(0, Node::size));
                let node = node.filter(|_| copied <= MOST).ok_or_else(|| TableError {
                    span: place.clone(),
                    kind: foreign("this stands for too much: write the value out".to_owned()),
                })?;
                Some(Node {
                    place,
                    ..node.clone()
                })
            }
            _ => None,
        };
        if open.len() > DEEPEST {
            break;
        }
        match (node, open.last_mut()) {
            (Some(node), Some((_, _, nodes))) => nodes.push(node),
            (Some(node), None) => return Ok(node),
            (None, _) => {}
        }
    }
    Err(TableError {
        span: 0..0,
        kind: TableErrorKind::Malformed("there is no policy in it".to_owned()),
    })
}

/// A list or a map of what has stood in it, up to the last of that.
fn closed(kind: Yaml, start: usize, nodes: Vec<Node>) -> Node {
    let end = nodes.last().map_or(start, |node| node.place.end);
    let kind = match kind {
        Yaml::Map(_) => {
            let mut nodes = nodes.into_iter();
            let mut entries = Vec::new();
            while let (Some(name), Some(value)) = (nodes.next(), nodes.next()) {
                entries.push((name, value));
            }
            Yaml::Map(entries)
        }
        _ => Yaml::List(nodes),
    };
    Node {
        kind,
        place: start..end.max(start),
    }
}

fn foreign(message: String) -> TableErrorKind {
    TableErrorKind::Foreign {
        message,
        help: Some("a policy of refine-plan is what its `Policy.write_policy` writes"),
    }
}
