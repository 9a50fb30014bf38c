//! How far what was begun reaches, as the layout shows it where brackets do not.

use super::Builder;
use crate::syntax::tokens::is_blank;

/// How far a line is indented, in bytes; nothing for an empty one.
fn margin(line: &str) -> Option<usize> {
    let text = line.trim_start_matches(is_blank);
    let is_empty = text.trim_end().is_empty();
    (!is_empty).then_some(line.len() - text.len())
}

impl Builder<'_> {
    /// Takes all that the entry at byte `start` reaches over as lost with it: of one mistake in a value of many lines,
    /// the rest of these lines says nothing.
    pub(super) fn lose_layout(&mut self, start: usize) {
        let end = self.reach(start);
        self.failed_at = self.failed_at.max(Some(end));
        self.lost_until = self.lost_until.max(end);
    }

    /// The first byte behind what begins on the line of byte `start`: the lines below that are indented further, and
    /// those beside it that a bracket or an `else` begins. Where brackets do not come out even among these, the item
    /// around them is not what it was to be, either.
    fn reach(&mut self, start: usize) -> usize {
        let before = self.text.get(..start).unwrap_or_default();
        let from = before.rfind('\n').map_or(0, |at| at + 1);
        let lines = self.text.get(from..).unwrap_or_default();
        let mut lines = lines.split_inclusive('\n');
        let first = lines.next().unwrap_or_default();
        let own = margin(first).unwrap_or_default();
        let mut end = from + first.len();
        let mut seen = end;
        for line in lines {
            let text = line.trim_start_matches(is_blank);
            let goes_on = text.starts_with('}') && own > 0 || text.starts_with("else");
            seen += line.len();
            match margin(line) {
                Some(at) if at > own || at == own && goes_on => end = seen,
                Some(_) => break,
                None => {}
            }
        }
        let depth = self.depth(start, end);
        if depth > 0 {
            // The `}` of the block around it closes what is open here.
            self.unopened.push(start);
        }
        let rest = self.text.get(end..).unwrap_or_default();
        if depth != 0 && own > 0 {
            let within = |line: &&str| margin(line) != Some(0);
            let within = rest.split_inclusive('\n').take_while(within);
            end += within.map(str::len).sum::<usize>();
            let closes = self
                .text
                .get(end..)
                .is_some_and(|rest| rest.starts_with('}'));
            end += usize::from(closes);
        }
        end
    }

    /// How many more braces are opened than closed.
    fn depth(&self, start: usize, end: usize) -> i32 {
        let first = self.tokens.partition_point(|token| token.start < start);
        let last = self.tokens.partition_point(|token| token.start < end);
        let within = self.tokens.get(first..last).unwrap_or_default();
        let braces = within.iter().map(|token| token.of(self.text));
        braces.fold(0, |depth, brace| match brace {
            "{" => depth + 1,
            "}" => depth - 1,
            _ => depth,
        })
    }
}
