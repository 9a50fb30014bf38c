//! The reader of PLAs.

use super::error::{PlaError, PlaErrorKind};
use super::{Kind, Part, Pla};
use std::ops::Range;

/// The most mistakes that are reported for one file.
const MISTAKES: usize = 20;

/// The PLA in a text.
///
/// A row stands on a line of its own: inputs `0`, `1`, `-` (also `2` and `~`), then outputs `0`, `1`, `-`, `~` (also `3`
/// for `0`, `4` for `1`, `2` for `-`); blanks and `|` between them say nothing. Everything after `#` is a comment.
///
/// # Errors
/// Every mistake, with its place; no more than a screenful.
pub fn read(text: &str) -> Result<Pla, Vec<PlaError>> {
    let mut reader = Reader::default();
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        reader.line(line, at);
        at += line.len();
        if reader.ended || reader.mistakes.len() >= MISTAKES {
            break;
        }
    }
    if reader.mistakes.is_empty() && !(reader.has_inputs && reader.has_outputs) {
        reader.wrong(0..text.len().min(1), PlaErrorKind::Size);
    }
    if reader.mistakes.is_empty() {
        Ok(reader.pla)
    } else {
        Err(reader.mistakes)
    }
}

#[derive(Default)]
struct Reader {
    pla: Pla,
    has_inputs: bool,
    has_outputs: bool,
    ended: bool,
    mistakes: Vec<PlaError>,
}

impl Reader {
    fn wrong(&mut self, span: Range<usize>, kind: PlaErrorKind) {
        self.mistakes.push(PlaError { span, kind });
    }

    fn line(&mut self, line: &str, at: usize) {
        let said = line.split('#').next().unwrap_or_default();
        let text = said.trim();
        if text.is_empty() {
            return;
        }
        let at = at + (said.len() - said.trim_start().len());
        if text.starts_with('.') {
            self.keyword(text, at);
        } else if self.has_inputs && self.has_outputs {
            self.row(text, at);
        } else {
            self.wrong(at..at + text.len(), PlaErrorKind::Size);
            self.ended = true;
        }
    }

    fn keyword(&mut self, text: &str, at: usize) {
        let mut words = text.split_whitespace();
        let keyword = words.next().unwrap_or_default();
        let span = at..at + text.len();
        match keyword {
            ".i" => {
                if let Some(number) = self.number(keyword, words.next(), span, self.has_inputs) {
                    self.pla.inputs = number;
                    self.has_inputs = true;
                }
            }
            ".o" => {
                if let Some(number) = self.number(keyword, words.next(), span, self.has_outputs) {
                    self.pla.outputs = number;
                    self.has_outputs = true;
                }
            }
            ".ilb" if self.has_inputs => {
                self.pla.input_names = words.map(str::to_owned).collect();
                self.names(span, self.pla.input_names.len(), self.pla.inputs);
            }
            ".ob" if self.has_outputs => {
                self.pla.output_names = words.map(str::to_owned).collect();
                self.names(span, self.pla.output_names.len(), self.pla.outputs);
            }
            ".ilb" | ".ob" => self.wrong(span, PlaErrorKind::Size),
            ".type" => match words.next().map(|word| (word, Kind::parse(word))) {
                Some((_, Some(kind))) => self.pla.kind = kind,
                Some((word, None)) => self.wrong(span, PlaErrorKind::Type(word.to_owned())),
                None => self.wrong(span, PlaErrorKind::Type(String::new())),
            },
            // The rows are counted as they come.
            ".p" => {}
            ".e" | ".end" => self.ended = true,
            other => {
                let word = at..at + other.len();
                self.wrong(word, PlaErrorKind::Keyword(other.to_owned()));
            }
        }
    }

    fn number(
        &mut self,
        keyword: &str,
        word: Option<&str>,
        span: Range<usize>,
        again: bool,
    ) -> Option<usize> {
        if again {
            self.wrong(span, PlaErrorKind::Again(keyword.to_owned()));
            return None;
        }
        let number = word.and_then(|word| word.parse::<u32>().ok());
        if number.is_none() {
            self.wrong(span, PlaErrorKind::Number(keyword.to_owned()));
        }
        number.map(|number| number as usize)
    }

    fn names(&mut self, span: Range<usize>, found: usize, wanted: usize) {
        if found != wanted {
            self.wrong(span, PlaErrorKind::Names { wanted, found });
        }
    }

    fn row(&mut self, text: &str, at: usize) {
        let inputs = self.pla.inputs;
        let wanted = inputs + self.pla.outputs;
        let words = self.pla.words();
        let first = self.pla.values.len();
        self.pla.values.resize(first + words, 0);
        if !self.pla.free.is_empty() {
            self.pla.free.resize(first + words, 0);
        }
        let mut found = 0;
        for (i, c) in text.bytes().enumerate() {
            if matches!(c, b' ' | b'\t' | b'|') {
                continue;
            }
            let known = match found < inputs {
                true => self.input(c, first, found),
                false => self.output(c),
            };
            if !known {
                let c = text.get(i..).and_then(|rest| rest.chars().next());
                let c = c.unwrap_or(char::REPLACEMENT_CHARACTER);
                self.wrong(at + i..at + i + c.len_utf8(), PlaErrorKind::Character(c));
                return;
            }
            found += 1;
        }
        if found != wanted {
            self.wrong(at..at + text.len(), PlaErrorKind::Width { wanted, found });
        }
        self.pla.starts.push(u32::try_from(at).unwrap_or(u32::MAX));
    }

    /// Takes an input in; `first` is the first word of its row.
    fn input(&mut self, c: u8, first: usize, input: usize) -> bool {
        let set = |words: &mut Vec<u64>| {
            if let Some(word) = words.get_mut(first + input / 64) {
                *word |= 1 << (input % 64);
            }
        };
        match c {
            b'0' => {}
            b'1' => set(&mut self.pla.values),
            b'-' | b'2' | b'~' => {
                self.pla.free.resize(self.pla.values.len(), 0);
                set(&mut self.pla.free);
            }
            _ => return false,
        }
        true
    }

    fn output(&mut self, c: u8) -> bool {
        let part = match c {
            b'1' | b'4' => Part::On,
            b'0' | b'3' => Part::Off,
            b'-' | b'2' => Part::Free,
            b'~' => Part::Silent,
            _ => return false,
        };
        self.pla.parts.push(part);
        true
    }
}
