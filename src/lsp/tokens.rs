//! What each token is, for colours: what a name stands for decides, where it stands for something.

use super::analysis::Analysis;
use crate::check::{Entity, Meaning, built_in_types};
use crate::source::Span;
use crate::spelling::RESERVED;
use crate::syntax::tokens::{Kind, Token};
use crate::syntax::words::{ASPECTS, NODES, UNITS};
use gen_lsp_types::{SemanticToken, SemanticTokensLegend};

/// The types of tokens, by their numbers.
const TYPES: [&str; 15] = [
    "comment",
    "keyword",
    "string",
    "number",
    "operator",
    "namespace",
    "type",
    "enumMember",
    "variable",
    "parameter",
    "function",
    "event",
    "property",
    "class",
    "macro",
];

/// The modifiers, by their bits.
const MODIFIERS: [&str; 3] = ["declaration", "readonly", "defaultLibrary"];

/// What the numbers mean.
pub(super) fn legend() -> SemanticTokensLegend {
    SemanticTokensLegend {
        token_types: TYPES.iter().map(|&word| word.to_owned()).collect(),
        token_modifiers: MODIFIERS.iter().map(|&word| word.to_owned()).collect(),
    }
}

/// The words that mean something where they stand, besides those that are no names anywhere.
const WORDS: [&str; 39] = [
    "std",
    "tick",
    "place",
    "wall",
    "robot",
    "sensor",
    "facing",
    "when",
    "local",
    "requires",
    "succeed",
    "fail",
    "control",
    "last",
    "after",
    "otherwise",
    "while",
    "per",
    "of",
    "memory",
    "equals",
    "never",
    "reaches",
    "within",
    "with",
    "probability",
    "success",
    "failure",
    "is",
    "learn",
    "for",
    "in",
    "drive",
    "tune",
    "test",
    "given",
    "succeeds",
    "fails",
    "runs",
];

/// The tokens of the main file that have a colour, each by its distance from the one before.
pub(super) fn tokens(analysis: &Analysis) -> Vec<SemanticToken> {
    let mut found = Vec::new();
    let (mut line, mut column) = (0, 0);
    for (at, token) in analysis.tokens.iter().enumerate() {
        let before = at.checked_sub(1).and_then(|at| analysis.tokens.get(at));
        let Some((word, modifiers)) = kind(analysis, *token, before) else {
            continue;
        };
        let Some(number) = TYPES.iter().position(|it| *it == word) else {
            continue;
        };
        let range = analysis.range_of(token.start, token.end);
        let (start, end) = (range.start, range.end);
        if start.line != end.line {
            continue;
        }
        let delta_line = start.line - line;
        let delta_start = match delta_line {
            0 => start.character - column,
            _ => start.character,
        };
        (line, column) = (start.line, start.character);
        found.push(SemanticToken {
            delta_line,
            delta_start,
            length: end.character - start.character,
            token_type: u32::try_from(number).unwrap_or(0),
            token_modifiers_bitset: modifiers,
        });
    }
    found
}

/// The type of a token with its modifiers.
fn kind(analysis: &Analysis, token: Token, before: Option<&Token>) -> Option<(&'static str, u32)> {
    let text = analysis.text();
    let written = token.of(text);
    match token.kind {
        Kind::Comment => Some(("comment", 0)),
        Kind::Number => Some(("number", 0)),
        Kind::Text => Some(("string", 0)),
        Kind::Mark => {
            (!matches!(written, "{" | "}" | "(" | ")" | "," | ":")).then_some(("operator", 0))
        }
        Kind::Word | Kind::Name => {
            let byte = u32::try_from(token.start).unwrap_or(u32::MAX);
            let meanings = &analysis.loaded.meanings;
            let meant = meanings.at(analysis.main(), byte);
            let meant = meant.filter(|(name, _)| name.range().start == token.start);
            match meant {
                Some((name, Meaning::Declared(declared))) => {
                    let entity = meanings.entity(declared)?;
                    Some(named(analysis, entity, name, declared))
                }
                Some((_, Meaning::BuiltIn)) => {
                    let is_type = built_in_types().any(|name| name == written);
                    Some((if is_type { "type" } else { "function" }, 4))
                }
                None => unnamed(text, written, token, before),
            }
        }
    }
}

fn named(analysis: &Analysis, entity: Entity, name: Span, declared: Span) -> (&'static str, u32) {
    let declares = u32::from(name == declared);
    let library = match analysis.path(declared.file) {
        Some(_) => 0,
        None => 4,
    };
    let (word, readonly) = match entity {
        Entity::World => ("namespace", 0),
        Entity::Place | Entity::Wall | Entity::Robot | Entity::Sensor => ("variable", 2),
        Entity::Kind | Entity::Enum => ("type", 0),
        Entity::Variant => ("enumMember", 0),
        Entity::Input => ("variable", 2),
        Entity::State => ("variable", 0),
        Entity::Local => ("variable", 0),
        Entity::Parameter => ("parameter", 0),
        Entity::Event => ("event", 0),
        Entity::Predicate | Entity::Let => ("property", 0),
        Entity::Behavior => ("function", 0),
        Entity::Tree => ("macro", 0),
        Entity::Task | Entity::Learner => ("class", 0),
        Entity::Test => ("string", 0),
    };
    (word, declares | readonly | library)
}

/// A word that stands for nothing: of the language, a unit, or a setting.
fn unnamed(
    text: &str,
    written: &str,
    token: Token,
    before: Option<&Token>,
) -> Option<(&'static str, u32)> {
    let after_number = before.is_some_and(|before| before.kind == Kind::Number);
    if after_number && UNITS.contains(&written) {
        return Some(("number", 0));
    }
    let rest = text.get(token.end..)?.trim_start();
    let set = rest.starts_with('=') && !rest.starts_with("==") && !rest.starts_with("=>");
    if set && !RESERVED.contains(&written) {
        return Some(("property", 0));
    }
    let is_node = NODES.iter().any(|(word, _)| *word == written);
    let known =
        RESERVED.contains(&written) || WORDS.contains(&written) || ASPECTS.contains(&written);
    (known || is_node).then_some(("keyword", 0))
}
