//! The parameters of what is called at a cursor.

use super::analysis::Analysis;
use super::cursor::{Before, Call};
use super::hover::markdown;
use super::outline::Outlined;
use super::reference::{self, Form};
use crate::spelling::bare;
use gen_lsp_types::{
    ActiveParameter, Documentation, ParameterInformation, ParameterInformationLabel, SignatureHelp,
    SignatureInformation,
};

/// The signatures of what is called at a byte of the main file.
pub(super) fn help(analysis: &Analysis, byte: u32) -> Option<SignatureHelp> {
    let before = Before::new(analysis.text(), &analysis.tokens, byte as usize);
    let call = before.call()?;
    let name = bare(call.callee.of(analysis.text()));
    let signatures = match declared(analysis, name, &call) {
        Some(signature) => vec![signature],
        None => reference::of(name)
            .filter(|form| form.is_called())
            .map(|form| of_form(form, &call))
            .collect(),
    };
    // The first that has as many parameters.
    let fits = |it: &SignatureInformation| {
        it.parameters
            .as_ref()
            .is_some_and(|params| params.len() > call.index)
    };
    let active = signatures.iter().position(fits).unwrap_or(0);
    (!signatures.is_empty()).then(|| SignatureHelp {
        active_signature: u32::try_from(active).ok(),
        active_parameter: None,
        signatures,
    })
}

fn declared(analysis: &Analysis, name: &str, call: &Call) -> Option<SignatureInformation> {
    let declared = analysis.loaded.meanings.value(name)?;
    let outlines = analysis.outlines();
    let found = outlines
        .iter()
        .find_map(|outlined| outlined.find(declared))?;
    let params = found.params?;
    let (label, places) = head(analysis, found);
    let named = call.name.as_ref().and_then(|named| {
        let mut params = params.params.iter();
        params.position(|param| param.name.name == *named)
    });
    let docs = found.docs.join("\n");
    Some(signature(label, places, docs, named.unwrap_or(call.index)))
}

/// The head of a declaration, and the bytes of it that its parameters take.
pub(super) fn head(analysis: &Analysis, found: &Outlined) -> (String, Vec<(usize, usize)>) {
    let mut label = format!("{}(", analysis.written(found.name.span));
    let mut places = Vec::new();
    let params = found.params.iter().flat_map(|params| &params.params);
    for (index, param) in params.enumerate() {
        if index > 0 {
            label.push_str(", ");
        }
        let start = label.len();
        label.push_str(analysis.written(param.span));
        places.push((start, label.len()));
    }
    label.push(')');
    (label, places)
}

fn of_form(form: &Form, call: &Call) -> SignatureInformation {
    let places = form.parameters();
    // The last parameter of `min(a, b, …)` stands for all that follow.
    let index = match form.written.contains('…') {
        true => call.index.min(places.len().saturating_sub(1)),
        false => call.index,
    };
    signature(form.written.to_owned(), places, form.says.clone(), index)
}

fn signature(
    label: String,
    places: Vec<(usize, usize)>,
    docs: String,
    active: usize,
) -> SignatureInformation {
    let units = |byte: usize| {
        let before = label.get(..byte).unwrap_or_default();
        u32::try_from(before.encode_utf16().count()).unwrap_or(u32::MAX)
    };
    let parameters = places.iter().map(|&(start, end)| ParameterInformation {
        label: ParameterInformationLabel::Tuple((units(start), units(end))),
        documentation: None,
    });
    let active = u32::try_from(active).unwrap_or(u32::MAX);
    SignatureInformation {
        parameters: Some(parameters.collect()),
        active_parameter: ((active as usize) < places.len())
            .then_some(ActiveParameter::Int(active)),
        documentation: (!docs.is_empty()).then(|| Documentation::MarkupContent(markdown(docs))),
        label,
    }
}
