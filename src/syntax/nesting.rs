//! How deep a text nests, before anything recurses into it.

use super::tokens::{Kind, Token};

/// How many brackets, prefix operators, powers, guards and `else if`s may stand within each other.
const LEVELS: usize = 64;

/// How many levels and binary operators may hang below each other: a sum leans to the left, one level a term.
const BRANCHES: usize = 1_000;

/// What hangs on one bracket at the present place.
#[derive(Default)]
struct Level {
    /// `not not`, `- -`
    prefixes: usize,
    /// `a ^ b ^ c`
    powers: usize,
    /// `a => b => c`
    guards: usize,
    /// `else if … else if …`
    alternatives: usize,
    /// `a + b + c`
    operators: usize,
}

impl Level {
    fn levels(&self) -> usize {
        1 + self.prefixes + self.powers + self.guards + self.alternatives
    }

    fn operator(&mut self) {
        self.powers = 0;
        self.operators += 1;
    }

    fn restart(&mut self) {
        *self = Self {
            alternatives: self.alternatives,
            ..Self::default()
        };
    }
}

/// The token at which `text` nests too deep.
pub(super) fn too_deep(text: &str, tokens: &[Token]) -> Option<Token> {
    let mut open: Vec<Level> = vec![Level::default()];
    let mut levels = 0;
    let mut operators = 0;
    let mut after_operand = false;
    let mut after_brace = false;
    for &token in tokens.iter().filter(|token| token.kind != Kind::Comment) {
        let spelling = token.of(text);
        let Some(level) = open.last_mut() else { break };
        levels -= level.levels().min(levels);
        operators -= level.operators.min(operators);
        let is_else = matches!(spelling, "else" | "elif" | "elseif" | "elsif");
        if after_brace && !is_else {
            level.alternatives = 0;
        }
        after_brace = spelling == "}";
        let mut operand = false;
        match spelling {
            "not" | "!" => level.prefixes += 1,
            "-" | "+" | "–" | "—" | "−" if !after_operand => level.prefixes += 1,
            "^" | "**" => level.powers += 1,
            "=>" | "->" => level.guards += 1,
            "and" | "or" | "&&" | "||" | "&" | "|" | "+" | "-" | "*" | "/" | "–" | "—" | "−"
            | "×" | "·" | "÷" => {
                level.operator();
            }
            "==" | "!=" | "<" | "<=" | ">" | ">=" | "<>" | "≤" | "≥" | "≠" | "===" | "!==" => {
                level.operator()
            }
            "else" | "elif" | "elseif" | "elsif" => level.alternatives += 1,
            "," | ":" | "=" | ";" | "let" | "if" | "for" => level.restart(),
            "(" | "{" | "[" | ")" | "}" | "]" => {}
            _ => {
                operand = true;
                level.prefixes = 0;
            }
        }
        levels += level.levels();
        operators += level.operators;
        match spelling {
            "(" | "{" | "[" => {
                open.push(Level::default());
                levels += 1;
            }
            ")" | "}" | "]" => {
                if open.len() > 1
                    && let Some(closed) = open.pop()
                {
                    levels -= closed.levels().min(levels);
                    operators -= closed.operators.min(operators);
                }
                if let Some(level) = open.last_mut() {
                    levels -= level.levels().min(levels);
                    operators -= level.operators.min(operators);
                    if spelling == "}" {
                        level.restart();
                    } else {
                        level.prefixes = 0;
                    }
                    levels += level.levels();
                    operators += level.operators;
                }
                operand = true;
            }
            _ => {}
        }
        after_operand = operand;
        if levels > LEVELS || levels + operators > BRANCHES {
            return Some(token);
        }
    }
    None
}
