//! The words of the project: one listing of all messages, and terms that no text uses.

mod linter;
mod messages;
pub mod sources;
