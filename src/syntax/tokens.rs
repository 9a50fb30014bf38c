//! The text cut into tokens, for what a grammar without memory cannot say: comments, depth, and the token at a place.

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A word, reserved or not.
    Word,
    /// A number, without its unit.
    Number,
    /// A name in backquotes; it may lack the second one.
    Name,
    /// A text in quotation marks; it may lack the second one.
    Text,
    /// A comment.
    Comment,
    /// A bracket, an operator or another character.
    Mark,
}

/// A token with its place.
#[derive(Clone, Copy, Debug)]
pub struct Token {
    /// What it is.
    pub kind: Kind,
    /// Its first byte.
    pub start: usize,
    /// One past its last byte.
    pub end: usize,
}

impl Token {
    /// The token as it is written in `text`.
    pub fn of(self, text: &str) -> &str {
        text.get(self.start..self.end).unwrap_or_default()
    }
}

const MARKS: [&str; 19] = [
    "===", "!==", "==", "=>", "!=", "<=", ">=", "<>", "->", "+=", "-=", "*=", "/=", "&&", "||",
    ":=", "**", "++", "..",
];

/// Whether a character separates tokens and belongs to none.
pub fn is_blank(letter: char) -> bool {
    matches!(letter, ' ' | '\t' | '\r' | '\n' | '\u{FEFF}')
}

/// The tokens of `text`, in order.
pub fn tokens(text: &str) -> Vec<Token> {
    let mut tokens = Vec::new();
    let mut start = 0;
    while let Some(rest) = text.get(start..).filter(|rest| !rest.is_empty()) {
        let blank = span_while(rest, is_blank);
        if blank > 0 {
            start += blank;
            continue;
        }
        let (kind, length) = first(rest);
        let end = start + length.max(1);
        tokens.push(Token { kind, start, end });
        start = end;
    }
    tokens
}

/// The most words behind a mark that are looked at.
const JOINED: usize = 8;

/// The words that a mark joins to what ends at a byte, without a blank: `to` and `do` behind `nothing` of `nothing-to-do`, a few
/// at most. `behind` are the tokens from there on.
pub fn joined_by<'t>(
    text: &str,
    mark: &str,
    mut end: usize,
    behind: &'t [Token],
) -> impl Iterator<Item = &'t Token> {
    let pairs = behind.chunks(2).take(JOINED);
    pairs.map_while(move |pair| match pair {
        [again, word]
            if again.of(text) == mark
                && again.start == end
                && word.start == again.end
                && word.kind == Kind::Word =>
        {
            end = word.end;
            Some(word)
        }
        _ => None,
    })
}

/// The kind and the length of the token that `rest` begins with.
fn first(rest: &str) -> (Kind, usize) {
    let letter = rest.chars().next().unwrap_or(' ');
    let follower = rest.chars().nth(1).unwrap_or(' ');
    if rest.starts_with("//") {
        let line = span_while(rest, |letter| letter != '\n');
        let comment = rest
            .get(..line)
            .unwrap_or_default()
            .trim_end_matches(is_blank);
        (Kind::Comment, comment.len())
    } else if letter.is_ascii_digit() || letter == '.' && follower.is_ascii_digit() {
        (Kind::Number, number(rest))
    } else if letter.is_alphanumeric() || letter == '_' {
        (
            Kind::Word,
            span_while(rest, |letter| letter.is_alphanumeric() || letter == '_'),
        )
    } else if letter == '`' {
        (Kind::Name, quoted(rest, '`'))
    } else if letter == '"' {
        (Kind::Text, quoted(rest, '"'))
    } else if letter == '“' {
        (Kind::Text, quoted(rest, '”'))
    } else {
        let mark = MARKS.iter().find(|mark| rest.starts_with(**mark));
        (
            Kind::Mark,
            mark.map_or(letter.len_utf8(), |mark| mark.len()),
        )
    }
}

/// The length of the number that `rest` begins with, as leniently as the grammar reads it.
fn number(rest: &str) -> usize {
    let hexadecimal = rest.strip_prefix("0x").or_else(|| rest.strip_prefix("0X"));
    if let Some(digits) =
        hexadecimal.map(|digits| span_while(digits, |letter| letter.is_ascii_hexdigit()))
        && digits > 0
    {
        return 2 + digits;
    }
    let digit = |letter: char| letter.is_ascii_digit() || letter == '_';
    let after = |length: usize| rest.get(length..).unwrap_or_default();
    let mut length = span_while(rest, digit);
    if after(length).starts_with('.') {
        length += 1 + span_while(after(length + 1), digit);
    }
    if after(length).starts_with(['e', 'E']) {
        let signed = usize::from(after(length + 1).starts_with(['-', '+']));
        let digits = span_while(after(length + 1 + signed), |letter| letter.is_ascii_digit());
        if digits > 0 {
            length += 1 + signed + digits;
        }
    }
    length
}

/// The length of a text from its quote to `close`, or to the end of the line.
fn quoted(rest: &str, close: char) -> usize {
    for (at, letter) in rest.char_indices().skip(1) {
        if letter == close {
            return at + letter.len_utf8();
        }
        if letter == '\n' {
            return rest
                .get(..at)
                .unwrap_or_default()
                .trim_end_matches(is_blank)
                .len();
        }
    }
    rest.trim_end_matches(is_blank).len()
}

fn span_while(text: &str, mut holds: impl FnMut(char) -> bool) -> usize {
    text.find(|letter| !holds(letter)).unwrap_or(text.len())
}
