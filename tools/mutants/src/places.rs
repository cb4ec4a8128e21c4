//! Finds the places of mutants in a source and puts the mutants there.

use std::collections::HashMap;
use std::ops::Range;

use proc_macro2::Span;
use serde::Deserialize;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{Arm, Block, Expr, ExprBinary, ExprStruct, ExprUnary, Signature};

use crate::edits::Edits;

/// A mutant of the list of cargo-mutants. Lines and columns count from 1.
#[derive(Deserialize)]
pub struct Mutant {
    pub file: String,
    genre: String,
    replacement: String,
    span: Range<Place>,
}

#[derive(Deserialize)]
struct Place {
    line: usize,
    column: usize,
}

/// Returns the source with the mutants in it, and the numbers of the mutants that are in.
pub fn put_mutants(source: &str, mutants: &[(u32, &Mutant)]) -> syn::Result<(String, Vec<u32>)> {
    let lines: Vec<usize> = [0]
        .into_iter()
        .chain(source.match_indices('\n').map(|(at, _)| at + 1))
        .collect();
    let offset = |place: &Place| {
        let line = &source[lines[place.line - 1]..];
        let before: usize = line
            .chars()
            .take(place.column - 1)
            .map(char::len_utf8)
            .sum();
        lines[place.line - 1] + before
    };
    let mut waiting: HashMap<(Genre, usize), Vec<Change>> = HashMap::new();
    for &(number, mutant) in mutants {
        let Some(genre) = Genre::of(&mutant.genre) else {
            continue;
        };
        let change = Change {
            number,
            range: offset(&mutant.span.start)..offset(&mutant.span.end),
            text: &mutant.replacement,
        };
        waiting
            .entry((genre, change.range.start))
            .or_default()
            .push(change);
    }
    let mut places = Places {
        edits: Edits::new(source),
        waiting,
        done: Vec::new(),
    };
    places.visit_file(&syn::parse_file(source)?);
    Ok((places.edits.apply(), places.done))
}

#[derive(PartialEq, Eq, Hash)]
enum Genre {
    Function,
    Operator,
    Guard,
    Arm,
    Field,
}

impl Genre {
    fn of(name: &str) -> Option<Self> {
        Some(match name {
            "FnValue" => Self::Function,
            "BinaryOperator" | "UnaryOperator" => Self::Operator,
            "MatchArmGuard" => Self::Guard,
            "MatchArm" => Self::Arm,
            "StructField" => Self::Field,
            _ => return None,
        })
    }
}

/// A mutant: the text that takes the place of a range of the source.
struct Change<'a> {
    number: u32,
    range: Range<usize>,
    text: &'a str,
}

struct Places<'a> {
    edits: Edits<'a>,
    /// The changes by genre and start.
    waiting: HashMap<(Genre, usize), Vec<Change<'a>>>,
    done: Vec<u32>,
}

fn start(span: Span) -> usize {
    span.byte_range().start
}

impl<'a> Places<'a> {
    /// The changes of this genre that start here.
    fn take(&mut self, genre: Genre, span: Span) -> Vec<Change<'a>> {
        let changes = self
            .waiting
            .remove(&(genre, start(span)))
            .unwrap_or_default();
        self.done.extend(changes.iter().map(|change| change.number));
        changes
    }

    /// Puts changed copies of an expression before it, and visits the expression between.
    fn choose(&mut self, changes: &[Change], whole: Range<usize>, visit: impl FnOnce(&mut Self)) {
        for Change {
            number,
            range,
            text,
        } in changes
        {
            let before = self.edits.text(whole.start..range.start);
            let after = self.edits.text(range.end..whole.end);
            let copy =
                format!("(if crate::mutant::is({number}) {{ {before}{text}{after} }} else {{ ");
            self.edits.insert(whole.start, copy);
        }
        visit(self);
        self.edits.insert(whole.end, " })".repeat(changes.len()));
    }

    fn function(&mut self, signature: &Signature, block: &Block) {
        if signature.constness.is_some() {
            return;
        }
        if let Some(first) = block.stmts.first() {
            let body = block.brace_token.span.open().byte_range().end;
            for Change { number, text, .. } in self.take(Genre::Function, first.span()) {
                self.edits.insert(
                    body,
                    format!(" if crate::mutant::is({number}) {{ return {text}; }}"),
                );
            }
        }
        self.visit_block(block);
    }
}

impl<'a> Visit<'_> for Places<'a> {
    fn visit_item_fn(&mut self, function: &syn::ItemFn) {
        self.function(&function.sig, &function.block);
    }

    fn visit_impl_item_fn(&mut self, function: &syn::ImplItemFn) {
        self.function(&function.sig, &function.block);
    }

    fn visit_trait_item_fn(&mut self, function: &syn::TraitItemFn) {
        if let Some(block) = &function.default {
            self.function(&function.sig, block);
        }
    }

    fn visit_expr_binary(&mut self, binary: &ExprBinary) {
        // A chain of `let` can be joined by `&&` only.
        let changes = match holds_let(&binary.left) || holds_let(&binary.right) {
            true => Vec::new(),
            false => self.take(Genre::Operator, binary.op.span()),
        };
        self.choose(&changes, binary.span().byte_range(), |places| {
            visit::visit_expr_binary(places, binary)
        });
    }

    fn visit_expr_unary(&mut self, unary: &ExprUnary) {
        let changes = self.take(Genre::Operator, unary.op.span());
        self.choose(&changes, unary.span().byte_range(), |places| {
            visit::visit_expr_unary(places, unary)
        });
    }

    fn visit_arm(&mut self, arm: &Arm) {
        let deleted = self.take(Genre::Arm, arm.span());
        let stays: String = deleted
            .iter()
            .map(|change| format!("!crate::mutant::is({}) && ", change.number))
            .collect();
        match &arm.guard {
            Some((_, guard)) => {
                let changes = self.take(Genre::Guard, guard.span());
                self.edits.insert(start(guard.span()), stays);
                self.choose(&changes, guard.span().byte_range(), |places| {
                    places.visit_expr(guard)
                });
            }
            None if deleted.is_empty() => {}
            None => self
                .edits
                .insert(arm.pat.span().byte_range().end, format!(" if {stays}true")),
        }
        self.visit_expr(&arm.body);
    }

    /// A field that is deleted comes from the rest of the expression: `..rest`.
    fn visit_expr_struct(&mut self, expression: &ExprStruct) {
        for field in &expression.fields {
            let changes = self.take(Genre::Field, field.span());
            let (Some(rest), [change]) = (&expression.rest, &changes[..]) else {
                self.visit_expr(&field.expr);
                continue;
            };
            let member = self.edits.text(field.member.span().byte_range());
            let value = field.expr.span().byte_range();
            let name = if field.colon_token.is_none() {
                format!("{member}: ")
            } else {
                String::new()
            };
            let rest = self.edits.text(rest.span().byte_range());
            let number = change.number;
            let copy =
                format!("{name}if crate::mutant::is({number}) {{ ({rest}).{member} }} else {{ ");
            self.edits.insert(value.start, copy);
            self.visit_expr(&field.expr);
            self.edits.insert(value.end, " }".into());
        }
        if let Some(rest) = &expression.rest {
            self.visit_expr(rest);
        }
    }

    // What the compiler itself computes has no switches.
    fn visit_item_const(&mut self, _: &syn::ItemConst) {}
    fn visit_item_static(&mut self, _: &syn::ItemStatic) {}
    fn visit_impl_item_const(&mut self, _: &syn::ImplItemConst) {}
    fn visit_trait_item_const(&mut self, _: &syn::TraitItemConst) {}
    fn visit_type_array(&mut self, _: &syn::TypeArray) {}
    fn visit_expr_const(&mut self, _: &syn::ExprConst) {}
    fn visit_generic_argument(&mut self, _: &syn::GenericArgument) {}

    fn visit_expr_repeat(&mut self, repeat: &syn::ExprRepeat) {
        self.visit_expr(&repeat.expr);
    }
}

/// Whether this operand of `&&` is a `let`, or a chain that has one.
fn holds_let(operand: &Expr) -> bool {
    match operand {
        Expr::Let(_) => true,
        Expr::Binary(binary) => holds_let(&binary.left) || holds_let(&binary.right),
        _ => false,
    }
}
