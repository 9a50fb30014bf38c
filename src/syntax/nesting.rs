//! How deep a text nests, before anything recurses into it.

use super::ast::chain_depth;
use super::tokens::{Kind, Token};

/// How many brackets, prefix operators, powers, guards and `else if`s may stand within each other.
const LEVELS: usize = 64;

/// How deep the tree of binary operators may be: a sum leans to the left, one level a term; long chains of `and` and `or` are
/// divided.
const BRANCHES: usize = 1_000;

/// How tightly binary operators bind, loosest first: `or`, `and`, comparisons, sums, terms.
const STRENGTHS: usize = 5;

/// Operands joined by operators that bind equally tightly.
#[derive(Clone, Copy, Default)]
struct Chain {
    operators: usize,
    /// The depth of the deepest operand that has ended.
    deepest: usize,
}

impl Chain {
    /// How deep its operators stand within each other.
    fn depth(self, strength: usize) -> usize {
        match strength {
            0 | 1 => chain_depth(self.operators),
            _ => self.operators,
        }
    }
}

/// What has stood inside one open bracket so far.
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
    /// The chains that are open, loosest first, each inside the one before.
    chains: [Chain; STRENGTHS],
    /// The depth of the brackets in the present operand of the innermost chain.
    operand: usize,
    /// The depth of the deepest expression that has ended.
    deepest: usize,
}

impl Level {
    fn levels(&self) -> usize {
        1 + self.prefixes + self.powers + self.guards + self.alternatives
    }

    /// The depth of what the chains that bind at least as tightly as `strength` hold.
    fn depth_from(&self, strength: usize) -> usize {
        let chains = self.chains.iter().skip(strength).rev();
        let strengths = (strength..STRENGTHS).rev();
        chains
            .zip(strengths)
            .fold(self.operand, |depth, (chain, strength)| {
                chain.depth(strength) + chain.deepest.max(depth)
            })
    }

    /// The depth of all that has stood inside the bracket.
    fn depth(&self) -> usize {
        self.deepest.max(self.depth_from(0))
    }

    /// An operator that binds as tightly as `strength`: it ends the chains that bind more tightly.
    fn operator(&mut self, strength: usize) {
        let ended = self.depth_from(strength + 1);
        self.powers = 0;
        self.operand = 0;
        let mut chains = self.chains.iter_mut().skip(strength);
        if let Some(chain) = chains.next() {
            chain.operators += 1;
            chain.deepest = chain.deepest.max(ended);
        }
        chains.for_each(|chain| *chain = Chain::default());
    }

    /// The beginning of another expression.
    fn restart(&mut self) {
        *self = Self {
            alternatives: self.alternatives,
            deepest: self.depth(),
            ..Self::default()
        };
    }
}

/// How tightly a binary operator binds.
fn strength(operator: &str) -> Option<usize> {
    match operator {
        "or" | "||" | "|" => Some(0),
        "and" | "&&" | "&" => Some(1),
        "==" | "!=" | "<" | "<=" | ">" | ">=" | "<>" | "≤" | "≥" | "≠" | "===" | "!==" => {
            Some(2)
        }
        "+" | "-" | "–" | "—" | "−" => Some(3),
        "*" | "/" | "×" | "·" | "÷" => Some(4),
        _ => None,
    }
}

/// The token at which `text` nests too deep.
pub(super) fn too_deep(text: &str, tokens: &[Token]) -> Option<Token> {
    let mut open: Vec<Level> = vec![Level::default()];
    let mut levels = 0;
    let mut after_operand = false;
    let mut after_brace = false;
    for &token in tokens.iter().filter(|token| token.kind != Kind::Comment) {
        let spelling = token.of(text);
        let Some(level) = open.last_mut() else { break };
        levels -= level.levels().min(levels);
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
            "else" | "elif" | "elseif" | "elsif" => level.alternatives += 1,
            "," | ":" | "=" | ";" | "let" | "if" | "for" => level.restart(),
            "(" | "{" | "[" | ")" | "}" | "]" => {}
            _ => match strength(spelling) {
                Some(strength) => level.operator(strength),
                None => {
                    operand = true;
                    level.prefixes = 0;
                }
            },
        }
        levels += level.levels();
        match spelling {
            "(" | "{" | "[" => {
                open.push(Level::default());
                levels += 1;
            }
            ")" | "}" | "]" => {
                let closed = if open.len() > 1 { open.pop() } else { None };
                let depth = closed.map_or(0, |closed| {
                    levels -= closed.levels().min(levels);
                    1 + closed.depth()
                });
                if let Some(level) = open.last_mut() {
                    levels -= level.levels().min(levels);
                    level.operand = level.operand.max(depth);
                    if spelling == "}" {
                        level.restart();
                    } else {
                        level.prefixes = 0;
                    }
                    levels += level.levels();
                }
                operand = true;
            }
            _ => {}
        }
        after_operand = operand;
        let depth = open.last().map_or(0, Level::depth);
        if levels > LEVELS || levels + depth > BRANCHES {
            return Some(token);
        }
    }
    None
}
