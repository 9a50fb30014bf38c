//! The conversation with an editor.

use super::capabilities::capabilities;
use super::{Server, Workspace};
use lsp_server::{Connection, Message, Notification, ProtocolError, Response};

/// Answers an editor until it has said goodbye or is gone.
///
/// # Errors
/// What the editor sends is not the Language Server Protocol.
pub fn serve(connection: &Connection, workspace: &dyn Workspace) -> Result<(), ProtocolError> {
    let (id, params) = connection.initialize_start()?;
    let mut server = Server::new(workspace, &params);
    connection.initialize_finish(id, capabilities())?;
    while let Ok(message) = connection.receiver.recv() {
        match message {
            Message::Request(request) => {
                if connection.handle_shutdown(&request)? {
                    return Ok(());
                }
                let answer = match server.answer(&request.method, request.params) {
                    Ok(value) => Response::new_ok(request.id, value),
                    Err(error) => Response::new_err(request.id, error.code, error.message),
                };
                send(connection, answer.into());
            }
            Message::Notification(notification) if notification.method == "exit" => return Ok(()),
            Message::Notification(notification) => {
                server.notice(&notification.method, notification.params);
            }
            Message::Response(_) => {}
        }
        // Of keystrokes that follow each other closely only the last is answered.
        if connection.receiver.is_empty() {
            for told in server.told() {
                let method = "textDocument/publishDiagnostics".to_owned();
                send(connection, Notification::new(method, told).into());
            }
        }
    }
    Ok(())
}

/// Sends a message; that the editor is gone is seen when nothing comes any more.
fn send(connection: &Connection, message: Message) {
    let _ = connection.sender.send(message);
}
