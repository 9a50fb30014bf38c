//! `btc lsp`

use super::check::programs;
use super::results::Found;
use super::{Failure, files};
use crate::driver::load::{LIBRARY, Reader};
use crate::lsp::{Workspace, serve};
use clap::Args;
use lsp_server::{Connection, Message};
use std::cell::OnceCell;
use std::io::{self, BufRead, Read};
use std::path::Path;
use std::sync::{Arc, OnceLock};
use std::thread;
use tempfile::TempDir;

/// The most bytes of one message: more than any program that is read.
const MOST: u64 = 64 << 20;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Speak over standard input and output, as it does anyway: many editors give this.
    #[arg(long, hide = true)]
    stdio: bool,
}

/// The files of the system, as the command line reads them.
#[derive(Default)]
struct Files {
    /// Holds the text of the library while the server runs, once it was asked for.
    library: OnceCell<Option<TempDir>>,
}

impl Workspace for Files {
    fn reader(&self, main: &str) -> Box<dyn Reader + '_> {
        Box::new(Found::of(main))
    }

    fn programs(&self, folder: &str) -> Vec<String> {
        match Path::new(folder).is_dir() {
            true => programs(folder).unwrap_or_default(),
            false => Vec::new(),
        }
    }

    fn library(&self) -> Option<String> {
        let folder = self.library.get_or_init(|| {
            let folder = tempfile::Builder::new().prefix("btc-").tempdir().ok()?;
            std::fs::write(folder.path().join("std.bt"), LIBRARY).ok()?;
            Some(folder)
        });
        let path = folder.as_ref()?.path().join("std.bt");
        Some(path.to_str()?.to_owned())
    }
}

/// Standard input, of which no message may say that it is longer than [`MOST`]: room is made for all of it at once.
struct Bounded<R>(R);

impl<R: BufRead> Read for Bounded<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.0.read(buffer)
    }
}

impl<R: BufRead> BufRead for Bounded<R> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        self.0.fill_buf()
    }

    fn consume(&mut self, amount: usize) {
        self.0.consume(amount);
    }

    /// Headers alone are read by lines.
    fn read_line(&mut self, line: &mut String) -> io::Result<usize> {
        let read = self.0.by_ref().take(MOST).read_line(line)?;
        let (name, value) = line.split_once(':').unwrap_or_default();
        let length = name.eq_ignore_ascii_case("content-length");
        match value.trim().parse::<u128>() {
            Ok(bytes) if length && bytes > u128::from(MOST) => {
                let why = format!("a message of {bytes} bytes is too long");
                Err(io::Error::new(io::ErrorKind::InvalidData, why))
            }
            _ => Ok(read),
        }
    }
}

/// Takes messages from standard input until the last.
fn receive(pass_on: impl Fn(Message) -> bool) -> io::Result<()> {
    let mut input = Bounded(io::stdin().lock());
    while let Some(message) = Message::read(&mut input)? {
        let last = matches!(&message, Message::Notification(it) if it.method == "exit");
        if !pass_on(message) || last {
            break;
        }
    }
    Ok(())
}

pub(super) fn run(_: &Arguments) -> Result<(), Failure> {
    let (connection, editor) = Connection::memory();
    let Connection { sender, receiver } = editor;
    // Known before the server hears that nothing more comes: it says more than that.
    let wrong = Arc::new(OnceLock::new());
    let found = wrong.clone();
    let reading = move || {
        receive(|message| sender.send(message).is_ok()).unwrap_or_else(|why| drop(found.set(why)));
    };
    let writing = move || {
        let mut output = io::stdout().lock();
        let mut messages = receiver.into_iter();
        messages.try_for_each(|message| message.write(&mut output))
    };
    let without = |why: io::Error| files::complain(&format!("no thread: {why}"));
    let writer = thread::Builder::new().spawn(writing).map_err(without)?;
    let reader = thread::Builder::new().spawn(reading).map_err(without)?;
    let served = serve(&connection, &Files::default());
    // The threads end when nothing more is to be sent.
    drop(connection);
    let told = |why: String| files::complain(&format!("the editor: {why}"));
    let served = served.map_err(|why| why.to_string());
    let heard = |why: &io::Error| Err(why.to_string());
    wrong.get().map_or(served, heard).map_err(told)?;
    let _ = reader.join();
    let sent = writer.join().unwrap_or(Ok(()));
    sent.map_err(|why| told(why.to_string()))
}
