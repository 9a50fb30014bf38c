//! What is answered to each request.

use super::analysis::Analysis;
use super::documents::{Document, Documents};
use super::editor::Editor;
use super::navigate::Declared;
use super::{
    Workspace, actions, complete, diagnostics, folding, format, hints, hover, lens, navigate,
    picture, rename, signature, symbols, tokens, uri,
};
use crate::syntax::Memory;
use gen_lsp_types as lsp;
use gen_lsp_types::{Position, TextDocumentPositionParams as At, Uri};
use lsp_server::{ErrorCode, ResponseError};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::collections::BTreeSet;
use std::rc::Rc;

/// As many programs of a workspace are looked through for a name.
const PROGRAMS: usize = 2000;

/// The documents of an editor, and what is known of them.
pub struct Server<'w> {
    workspace: &'w dyn Workspace,
    documents: Documents,
    /// The texts that were parsed last.
    memory: Memory,
    editor: Editor,
    /// Where the text of the library can be read, once it was asked for.
    library: Option<String>,
    /// Documents that were closed, whose mistakes are to be shown no more.
    closed: Vec<Uri>,
}

impl<'w> Server<'w> {
    /// A server without open documents, for an editor that introduces itself so.
    pub fn new(workspace: &'w dyn Workspace, params: &Value) -> Self {
        Self {
            workspace,
            documents: Documents::default(),
            memory: Memory::default(),
            editor: Editor::of(params),
            library: None,
            closed: Vec::new(),
        }
    }

    /// The answer to a request.
    ///
    /// # Errors
    /// The request is not known, its parameters are wrong, or it cannot be done.
    pub fn answer(&mut self, method: &str, params: Value) -> Result<Value, ResponseError> {
        match method {
            "textDocument/hover" => {
                let (found, byte) =
                    self.at(&read::<lsp::HoverParams>(params)?.text_document_position_params)?;
                written(hover::hover(&found, byte))
            }
            "textDocument/definition" => {
                let at = read::<lsp::DefinitionParams>(params)?.text_document_position_params;
                let (found, byte) = self.at(&at)?;
                if self.library.is_none() {
                    self.library = self.workspace.library();
                }
                let library = self.library.as_deref();
                written(navigate::definition(&found, &self.documents, library, byte))
            }
            "textDocument/references" => {
                let params = read::<lsp::ReferenceParams>(params)?;
                let (found, byte) = self.at(&params.text_document_position_params)?;
                let Some((_, declared)) = found.declared_at(byte) else {
                    return Ok(Value::Null);
                };
                let declared = Declared::of(&found, declared);
                let programs = self.programs(&found, Some(&declared.name));
                let with = params.context.include_declaration;
                written(navigate::references(
                    &programs,
                    &self.documents,
                    &declared,
                    with,
                ))
            }
            "textDocument/documentHighlight" => {
                let at =
                    read::<lsp::DocumentHighlightParams>(params)?.text_document_position_params;
                let (found, byte) = self.at(&at)?;
                written(navigate::highlights(&found, byte))
            }
            "textDocument/prepareRename" => {
                let at = read::<lsp::PrepareRenameParams>(params)?.text_document_position_params;
                let (found, byte) = self.at(&at)?;
                written(self.renameable(&found, byte)?)
            }
            "textDocument/rename" => {
                let params = read::<lsp::RenameParams>(params)?;
                let (found, byte) = self.at(&params.text_document_position_params)?;
                self.renameable(&found, byte)?;
                let Some((_, declared)) = found.declared_at(byte) else {
                    return Ok(Value::Null);
                };
                let declared = Declared::of(&found, declared);
                let programs = self.programs(&found, Some(&declared.name));
                let new = &params.new_name;
                let edit =
                    rename::rename(&programs, &self.documents, self.workspace, &declared, new);
                written(edit.map_err(refused)?)
            }
            "textDocument/documentSymbol" => {
                let found =
                    self.of(&read::<lsp::DocumentSymbolParams>(params)?.text_document.uri)?;
                written(symbols::of_document(&found))
            }
            "workspace/symbol" => {
                let query = read::<lsp::WorkspaceSymbolParams>(params)?.query;
                let programs = self.all_programs(None);
                written(symbols::of_workspace(&programs, &self.documents, &query))
            }
            "textDocument/completion" => {
                let at = read::<lsp::CompletionParams>(params)?.text_document_position_params;
                let (found, byte) = self.at(&at)?;
                written(complete::complete(&found, byte, self.editor.snippets))
            }
            "textDocument/signatureHelp" => {
                let at = read::<lsp::SignatureHelpParams>(params)?.text_document_position_params;
                let (found, byte) = self.at(&at)?;
                written(signature::help(&found, byte))
            }
            "textDocument/codeAction" => {
                let params = read::<lsp::CodeActionParams>(params)?;
                let found = self.of(&params.text_document.uri)?;
                written(actions::actions(&found, &self.documents, params.range))
            }
            "textDocument/formatting" => {
                let found = self.of(&read::<lsp::DocumentFormattingParams>(params)?
                    .text_document
                    .uri)?;
                written(format::document(&found))
            }
            "textDocument/rangeFormatting" => {
                let params = read::<lsp::DocumentRangeFormattingParams>(params)?;
                let found = self.of(&params.text_document.uri)?;
                written(format::lines(&found, params.range))
            }
            "textDocument/foldingRange" => {
                let found = self.of(&read::<lsp::FoldingRangeParams>(params)?.text_document.uri)?;
                written(folding::folds(&found))
            }
            "textDocument/semanticTokens/full" => {
                let found =
                    self.of(&read::<lsp::SemanticTokensParams>(params)?.text_document.uri)?;
                written(lsp::SemanticTokens {
                    result_id: None,
                    data: tokens::tokens(&found),
                })
            }
            "textDocument/inlayHint" => {
                let params = read::<lsp::InlayHintParams>(params)?;
                let found = self.of(&params.text_document.uri)?;
                written(hints::hints(&found, params.range))
            }
            "textDocument/codeLens" => {
                let found = self.of(&read::<lsp::CodeLensParams>(params)?.text_document.uri)?;
                written(lens::lenses(&found, &self.documents, &self.editor.commands))
            }
            "workspace/executeCommand" => {
                let params = read::<lsp::ExecuteCommandParams>(params)?;
                if params.command != picture::COMMAND {
                    return Err(refused(format!("`{}` is no command", params.command)));
                }
                let wanted = params.arguments.into_iter().flatten().next();
                let wanted = read::<picture::Wanted>(wanted.unwrap_or_default())?;
                let path = uri::path(&wanted.uri);
                let found = self.analysis(&path);
                let found = found.or_else(|| self.closed_program(&path, None));
                let missing = || refused(format!("{} cannot be read", wanted.uri.0));
                let found = found.ok_or_else(missing)?;
                written(picture::picture(&found, wanted))
            }
            _ => Err(error(
                ErrorCode::MethodNotFound,
                format!("`{method}` is not known"),
            )),
        }
    }

    /// Takes notice of what the editor says. What is not understood is passed over, as the protocol wants it.
    pub fn notice(&mut self, method: &str, params: Value) {
        match method {
            "textDocument/didOpen" => {
                let Ok(params) = read::<lsp::DidOpenTextDocumentParams>(params) else {
                    return;
                };
                let opened = params.text_document;
                let path = uri::path(&opened.uri);
                // An editor that knows no other name for the language sends all plain texts.
                if opened.language_id.as_str() == "plaintext" && !path.ends_with(".bt") {
                    return;
                }
                let document = Document::new(opened.uri, opened.version, opened.text);
                self.documents.open.insert(path.clone(), document);
                self.documents.changed(&path);
            }
            "textDocument/didChange" => {
                let Ok(params) = read::<lsp::DidChangeTextDocumentParams>(params) else {
                    return;
                };
                let uri = &params.text_document.text_document_identifier.uri;
                let Some(document) = self.documents.get_mut(uri) else {
                    return;
                };
                document.change(params.content_changes);
                document.version = params.text_document.version;
                self.documents.changed(&uri::path(uri));
            }
            "textDocument/didClose" => {
                let Ok(params) = read::<lsp::DidCloseTextDocumentParams>(params) else {
                    return;
                };
                let path = uri::path(&params.text_document.uri);
                self.documents.open.remove(&path);
                self.documents.changed(&path);
                self.closed.push(params.text_document.uri);
            }
            "textDocument/didSave" | "workspace/didChangeWatchedFiles" => {
                for document in self.documents.open.values_mut() {
                    document.analysis = None;
                    document.untold = true;
                }
            }
            "workspace/didChangeWorkspaceFolders" => {
                let Ok(params) = read::<lsp::DidChangeWorkspaceFoldersParams>(params) else {
                    return;
                };
                let gone: Vec<String> = (params.event.removed.iter())
                    .map(|folder| uri::path(&folder.uri))
                    .collect();
                let folders = &mut self.editor.folders;
                folders.retain(|folder| !gone.contains(folder));
                let added = params.event.added.iter();
                folders.extend(added.map(|folder| uri::path(&folder.uri)));
            }
            _ => {}
        }
    }

    /// What is wrong with the documents that have changed since it was asked for last.
    pub fn told(&mut self) -> Vec<lsp::PublishDiagnosticsParams> {
        let closed = std::mem::take(&mut self.closed).into_iter();
        let mut told: Vec<lsp::PublishDiagnosticsParams> = closed
            .filter(|uri| !self.documents.open.contains_key(&uri::path(uri)))
            .map(|uri| lsp::PublishDiagnosticsParams {
                uri,
                version: None,
                diagnostics: Vec::new(),
            })
            .collect();
        let untold = self
            .documents
            .open
            .iter()
            .filter(|(_, document)| document.untold);
        let untold: Vec<String> = untold.map(|(path, _)| path.clone()).collect();
        for path in untold {
            let Some(found) = self.analysis(&path) else {
                continue;
            };
            let diagnostics = match self.library.as_ref() == Some(&path) {
                // The library is checked where it is used.
                true => Vec::new(),
                false => diagnostics::told(&found, &self.documents),
            };
            if let Some(document) = self.documents.open.get_mut(&path) {
                document.untold = false;
                told.push(lsp::PublishDiagnosticsParams {
                    uri: document.uri.clone(),
                    version: Some(document.version),
                    diagnostics,
                });
            }
        }
        told
    }

    /// What is known of the document at a path, found out now if something has changed.
    fn analysis(&mut self, path: &str) -> Option<Rc<Analysis>> {
        let document = self.documents.open.get(path)?;
        if let Some(known) = &document.analysis {
            return Some(known.clone());
        }
        let text = document.text.clone();
        let found = Rc::new(Analysis::of(
            path,
            text,
            &self.documents,
            self.workspace,
            &mut self.memory,
        ));
        let document = self.documents.open.get_mut(path)?;
        document.analysis = Some(found.clone());
        Some(found)
    }

    fn of(&mut self, uri: &Uri) -> Result<Rc<Analysis>, ResponseError> {
        let found = self.analysis(&uri::path(uri));
        found.ok_or_else(|| error(ErrorCode::InvalidParams, format!("{} is not open", uri.0)))
    }

    fn at(&mut self, at: &At) -> Result<(Rc<Analysis>, u32), ResponseError> {
        let found = self.of(&at.text_document.uri)?;
        let Position { line, character } = at.position;
        let byte = found.byte(Position { line, character });
        Ok((found, byte))
    }

    /// What a rename at a byte would be of: the place of the name.
    fn renameable(&self, found: &Analysis, byte: u32) -> Result<lsp::Range, ResponseError> {
        let none = || refused("nothing that is declared stands here".to_owned());
        let (name, declared) = found.declared_at(byte).ok_or_else(none)?;
        match found.path(declared.file) {
            Some(_) => Ok(found.range(name)),
            None => {
                let name = found.written(name);
                Err(refused(format!("`{name}` is of the standard library")))
            }
        }
    }

    /// The programs that could read the file of a declaration: this one first, then those of the workspace.
    fn programs(&mut self, own: &Rc<Analysis>, name: Option<&str>) -> Vec<Rc<Analysis>> {
        let mut programs = self.all_programs(name);
        let main = own.path(own.main()).map(str::to_owned);
        programs.retain(|program| program.path(program.main()) != main.as_deref());
        programs.insert(0, own.clone());
        programs
    }

    /// The programs of the workspace, open or not, whose text has a name.
    fn all_programs(&mut self, name: Option<&str>) -> Vec<Rc<Analysis>> {
        let mut paths: BTreeSet<String> = self.documents.open.keys().cloned().collect();
        for folder in &self.editor.folders {
            paths.extend(self.workspace.programs(folder));
        }
        let mut programs = Vec::new();
        for path in paths.into_iter().take(PROGRAMS) {
            if self.library.as_ref() == Some(&path) {
                continue;
            }
            let program = match self.documents.open.contains_key(&path) {
                true => self.analysis(&path),
                false => self.closed_program(&path, name),
            };
            programs.extend(program);
        }
        programs
    }

    /// A program that is not open, if its text has a name.
    fn closed_program(&self, path: &str, name: Option<&str>) -> Option<Rc<Analysis>> {
        let bytes = self.workspace.reader(path).read(path).ok()?;
        let text = String::from_utf8(bytes).ok()?;
        let has = name.is_none_or(|name| text.contains(name));
        let memory = &mut Memory::default();
        has.then(|| {
            let analysis = Analysis::of(path, text, &self.documents, self.workspace, memory);
            Rc::new(analysis)
        })
    }
}

fn read<P: DeserializeOwned>(params: Value) -> Result<P, ResponseError> {
    serde_json::from_value(params).map_err(|why| error(ErrorCode::InvalidParams, why.to_string()))
}

fn written(answer: impl Serialize) -> Result<Value, ResponseError> {
    serde_json::to_value(answer).map_err(|why| error(ErrorCode::InternalError, why.to_string()))
}

fn refused(message: String) -> ResponseError {
    error(ErrorCode::RequestFailed, message)
}

fn error(code: ErrorCode, message: String) -> ResponseError {
    ResponseError {
        code: code as i32,
        message,
        data: None,
    }
}
