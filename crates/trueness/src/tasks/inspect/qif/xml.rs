//! XML of QIF documents: elements, references, attributes of the user.

use trueness_files::write::{self, Attributes};

/// Blanks for each level.
pub const INDENT: usize = 2;

/// A document under construction. What is numbered has a number of its own, from 1.
pub struct Xml {
    xml: write::Xml,
    last: u32,
}

/// An attribute of the user.
pub enum Value {
    /// A text.
    Text(String),
    /// A number.
    Number(f64),
}

impl From<&str> for Value {
    fn from(text: &str) -> Value {
        Value::Text(text.into())
    }
}

impl From<String> for Value {
    fn from(text: String) -> Value {
        Value::Text(text)
    }
}

impl From<f64> for Value {
    fn from(x: f64) -> Value {
        Value::Number(x)
    }
}

/// A number as `xs:decimal` has it: all digits, no exponent.
pub fn decimal(x: f64) -> String {
    format!("{x}")
}

/// Numbers of a place or direction.
pub fn three(p: [f64; 3]) -> String {
    p.map(decimal).join(" ")
}

impl Xml {
    /// What stands within the outermost element.
    pub fn within_root() -> Xml {
        Xml { xml: write::Xml::part(INDENT, 1), last: 0 }
    }

    /// The text so far.
    pub fn finish(mut self) -> String {
        self.xml.take()
    }

    /// A new number; the greatest is the last one.
    pub fn number(&mut self) -> u32 {
        self.last += 1;
        self.last
    }

    /// The greatest number given.
    pub fn last(&self) -> u32 {
        self.last
    }

    /// An element with what `inside` writes.
    pub fn element(&mut self, name: &str, attributes: Attributes, inside: impl FnOnce(&mut Xml)) {
        self.xml.start(name, attributes);
        inside(self);
        self.xml.end();
    }

    /// An element without content.
    pub fn empty(&mut self, name: &str, attributes: Attributes) {
        self.xml.empty(name, attributes);
    }

    /// An element of text.
    pub fn leaf(&mut self, name: &str, text: &str) {
        self.leaf_with(name, &[], text);
    }

    /// An element of text with attributes.
    pub fn leaf_with(&mut self, name: &str, attributes: Attributes, text: &str) {
        self.xml.leaf(name, attributes, text);
    }

    /// References to what is numbered so; nothing where there are none.
    pub fn references(&mut self, name: &str, ids: &[u32]) {
        if !ids.is_empty() {
            self.element(name, &[("n", ids.len().to_string())], |x| {
                ids.iter().for_each(|id| x.leaf("Id", &id.to_string()));
            });
        }
    }

    /// What QIF has no element for.
    pub fn attributes(&mut self, all: &[(&str, Value)]) {
        if all.is_empty() {
            return;
        }
        self.element("Attributes", &[("n", all.len().to_string())], |x| {
            for (name, value) in all {
                let (tag, value) = match value {
                    Value::Text(text) => ("AttributeStr", text.clone()),
                    Value::Number(n) => ("AttributeD1", n.to_string()),
                };
                x.empty(tag, &[("name", (*name).to_string()), ("value", value)]);
            }
        });
    }
}
