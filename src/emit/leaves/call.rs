//! Names taken apart: `goto(A)` is a call of `goto`.

/// A name without the backquotes that the language writes around it.
pub(in crate::emit) fn unquoted(name: &str) -> &str {
    let inner = name.strip_prefix('`').and_then(|n| n.strip_suffix('`'));
    inner.filter(|n| !n.contains('`')).unwrap_or(name)
}

/// A name as an argument: without its backquotes, unless it would look like a call, or like an entry of the blackboard
/// of BehaviorTree.CPP.
pub fn argument(name: &str) -> &str {
    match unquoted(name) {
        inner if inner.contains(['(', '{']) => name,
        inner => inner,
    }
}

/// A name with its arguments, as the language writes it.
#[derive(Clone, Debug)]
pub struct Call {
    /// What is called.
    pub family: String,
    /// With what.
    pub arguments: Vec<Argument>,
}

/// An argument, by the name of its parameter if that is known.
#[derive(Clone, Debug)]
pub struct Argument {
    /// Its parameter.
    pub parameter: Option<String>,
    /// As the language writes it.
    pub value: String,
}

impl Call {
    /// Takes a name apart; one that is no call is a family of its own.
    pub fn of(name: &str) -> Self {
        let whole = || Self {
            family: name.to_owned(),
            arguments: Vec::new(),
        };
        let open = match name.strip_prefix('`').and_then(|rest| rest.find('`')) {
            Some(close) => Some(close + 2),
            None => name.find('('),
        };
        let Some((family, rest)) = open.and_then(|open| name.split_at_checked(open)) else {
            return whole();
        };
        let inner = rest.strip_prefix('(').and_then(|r| r.strip_suffix(')'));
        match inner.and_then(split) {
            Some(arguments) if !family.is_empty() => Self {
                family: family.to_owned(),
                arguments: arguments.into_iter().map(Argument::of).collect(),
            },
            _ => whole(),
        }
    }

    /// Gives the parameters of arguments by position their declared names, or a number.
    pub fn complete(&mut self, declared: Option<&Vec<String>>) {
        for (position, argument) in self.arguments.iter_mut().enumerate() {
            argument.parameter.get_or_insert_with(|| {
                let known = declared.and_then(|names| names.get(position)).cloned();
                known.unwrap_or_else(|| format!("argument_{}", position + 1))
            });
        }
    }

    /// The value of a parameter, if it is given.
    pub fn value(&self, parameter: &str) -> Option<&str> {
        let mut arguments = self.arguments.iter();
        let found = arguments.find(|argument| argument.parameter.as_deref() == Some(parameter));
        found.map(|argument| argument.value.as_str())
    }
}

impl Argument {
    /// `value` or `parameter = value`
    fn of(text: &str) -> Self {
        if let Some((parameter, value)) = text.split_once(" = ")
            && parameter.chars().all(|c| c.is_alphanumeric() || c == '_')
        {
            return Self {
                parameter: Some(parameter.to_owned()),
                value: argument(value.trim()).to_owned(),
            };
        }
        Self {
            parameter: None,
            value: argument(text).to_owned(),
        }
    }
}

/// The parts of a list, at the commas outside brackets and quotes; `None` if it is no list of arguments.
fn split(list: &str) -> Option<Vec<&str>> {
    let mut parts = Vec::new();
    let (mut depth, mut quoted, mut start) = (0_u32, false, 0);
    for (at, c) in list.char_indices() {
        match c {
            '`' => quoted = !quoted,
            _ if quoted => {}
            '(' | '{' => depth += 1,
            ')' | '}' => depth = depth.checked_sub(1)?,
            ',' if depth == 0 => {
                parts.push(list.get(start..at)?.trim());
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(list.get(start..)?.trim());
    let sound = |part: &&str| !part.is_empty() && !part.starts_with('{');
    (depth == 0 && !quoted && parts.iter().all(sound)).then_some(parts)
}
