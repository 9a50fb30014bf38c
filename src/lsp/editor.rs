//! What an editor says of itself when it introduces itself.

use super::uri;
use serde_json::Value;

/// What is known of the editor.
pub(super) struct Editor {
    /// The folders of the workspace.
    pub(super) folders: Vec<String>,
    /// Whether it fills in places of what is completed.
    pub(super) snippets: bool,
    /// The commands of its own that it has for what is offered above items.
    pub(super) commands: Vec<String>,
}

impl Editor {
    /// The editor that sends these parameters of `initialize`.
    pub(super) fn of(params: &Value) -> Self {
        let path = |value: &Value| value.as_str().map(|it| uri::path(&it.into()));
        let mut folders: Vec<String> = list(params.get("workspaceFolders"))
            .filter_map(|folder| path(folder.get("uri")?))
            .collect();
        if folders.is_empty() {
            folders.extend(params.get("rootUri").and_then(path));
        }
        let snippets =
            params.pointer("/capabilities/textDocument/completion/completionItem/snippetSupport");
        let commands = list(params.pointer("/initializationOptions/commands"));
        Self {
            folders,
            snippets: snippets.and_then(Value::as_bool).unwrap_or(false),
            commands: commands
                .filter_map(|command| command.as_str().map(str::to_owned))
                .collect(),
        }
    }
}

fn list(value: Option<&Value>) -> impl Iterator<Item = &Value> {
    value.and_then(Value::as_array).into_iter().flatten()
}
