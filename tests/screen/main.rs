//! The explorer: its state, words, numbers and pictures, and the program in a terminal.

#[path = "../common/mod.rs"]
mod common;
mod formula;
mod lessons;
mod memory;
mod numbers;
mod play;
mod screens;
mod session;
mod state;
mod terminal;
mod ticks;
mod why;
mod words;
