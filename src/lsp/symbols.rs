//! What is declared in a document, and in the workspace.

use super::analysis::Analysis;
use super::documents::Documents;
use super::outline::{Outlined, outline};
use crate::check::Entity;
use gen_lsp_types::{
    BaseSymbolInformation, DocumentSymbol, SymbolKind, WorkspaceSymbol, WorkspaceSymbolLocation,
};
use std::rc::Rc;

/// As many symbols of a workspace are shown.
const MANY: usize = 500;

/// What the main file declares, as a tree.
pub(super) fn of_document(analysis: &Analysis) -> Vec<DocumentSymbol> {
    let outlines = outline(&analysis.loaded.ast);
    outlines.iter().map(|it| symbol(analysis, it)).collect()
}

#[allow(deprecated, reason = "the field has to be given")]
fn symbol(analysis: &Analysis, outlined: &Outlined) -> DocumentSymbol {
    let inner: Vec<DocumentSymbol> = (outlined.inner.iter())
        .map(|inner| symbol(analysis, inner))
        .collect();
    DocumentSymbol {
        name: outlined.name.name.clone(),
        detail: Some(what(outlined.entity).to_owned()),
        kind: kind(outlined.entity),
        tags: None,
        deprecated: None,
        range: analysis.range(outlined.span.to(outlined.name.span)),
        selection_range: analysis.range(outlined.name.span),
        children: Some(inner).filter(|inner| !inner.is_empty()),
    }
}

/// What programs declare in their main files whose name holds the letters of a query, in their order.
pub(super) fn of_workspace(
    programs: &[Rc<Analysis>],
    documents: &Documents,
    query: &str,
) -> Vec<WorkspaceSymbol> {
    fn flat<'a>(outlined: Outlined<'a>, found: &mut Vec<Outlined<'a>>) {
        let inner = outlined.inner.clone();
        found.push(outlined);
        for inner in inner {
            flat(inner, found);
        }
    }
    let mut symbols = Vec::new();
    for program in programs {
        let mut found = Vec::new();
        for outlined in outline(&program.loaded.ast) {
            flat(outlined, &mut found);
        }
        found.retain(|outlined| has(&outlined.name.name, query));
        symbols.extend(found.into_iter().filter_map(|outlined| {
            Some(WorkspaceSymbol {
                location: WorkspaceSymbolLocation::Location(
                    program.location(outlined.name.span, documents)?,
                ),
                data: None,
                base_symbol_information: BaseSymbolInformation {
                    name: outlined.name.name.clone(),
                    kind: kind(outlined.entity),
                    tags: None,
                    container_name: None,
                },
            })
        }));
    }
    symbols.truncate(MANY);
    symbols
}

/// Whether a name has the letters of a query in their order, whatever their case.
fn has(name: &str, query: &str) -> bool {
    let mut letters = name.chars().flat_map(char::to_lowercase);
    let mut wanted = query.chars().flat_map(char::to_lowercase);
    wanted.all(|wanted| letters.any(|letter| letter == wanted))
}

/// What is declared, in a word or two.
pub(super) fn what(entity: Entity) -> &'static str {
    match entity {
        Entity::World => "world",
        Entity::Place => "place",
        Entity::Wall => "wall",
        Entity::Kind => "kind",
        Entity::Robot => "robot",
        Entity::Sensor => "sensor",
        Entity::Enum => "enum",
        Entity::Variant => "variant",
        Entity::Input => "input",
        Entity::State => "state",
        Entity::Event => "event",
        Entity::Let => "shared expression",
        Entity::Predicate => "predicate",
        Entity::Behavior => "behavior",
        Entity::Tree => "tree",
        Entity::Task => "task",
        Entity::Learner => "learner",
        Entity::Test => "test",
        Entity::Parameter => "parameter",
        Entity::Local => "local",
    }
}

fn kind(entity: Entity) -> SymbolKind {
    match entity {
        Entity::World => SymbolKind::Namespace,
        Entity::Place | Entity::Wall => SymbolKind::Constant,
        Entity::Kind | Entity::Enum => SymbolKind::Enum,
        Entity::Robot | Entity::Task => SymbolKind::Class,
        Entity::Sensor => SymbolKind::Field,
        Entity::Variant => SymbolKind::EnumMember,
        Entity::Input | Entity::State | Entity::Parameter | Entity::Local => SymbolKind::Variable,
        Entity::Event => SymbolKind::Event,
        Entity::Let | Entity::Behavior => SymbolKind::Function,
        Entity::Predicate => SymbolKind::Boolean,
        Entity::Tree | Entity::Learner => SymbolKind::Object,
        Entity::Test => SymbolKind::Method,
    }
}
