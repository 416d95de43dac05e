//! XML of QIF documents: elements, references, attributes of the user.

use super::super::lists::escaped;

/// A document under construction. What is numbered has a number of its own, from 1.
#[derive(Default)]
pub struct Xml {
    text: String,
    open: Vec<String>,
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
    /// The text so far.
    pub fn finish(self) -> String {
        self.text
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

    fn indent(&mut self) {
        for _ in 0..=self.open.len() {
            self.text.push_str("  ");
        }
    }

    fn tag(&mut self, name: &str, attributes: &[(&str, String)], end: &str) {
        self.indent();
        self.text.push('<');
        self.text.push_str(name);
        for (key, value) in attributes {
            self.text.push_str(&format!(" {key}=\"{}\"", escaped(value)));
        }
        self.text.push_str(end);
    }

    /// An element with what `inside` writes.
    pub fn element(&mut self, name: &str, attributes: &[(&str, String)], inside: impl FnOnce(&mut Xml)) {
        self.tag(name, attributes, ">\n");
        self.open.push(name.into());
        inside(self);
        self.open.pop();
        self.indent();
        self.text.push_str(&format!("</{name}>\n"));
    }

    /// An element without content.
    pub fn empty(&mut self, name: &str, attributes: &[(&str, String)]) {
        self.tag(name, attributes, "/>\n");
    }

    /// An element of text.
    pub fn leaf(&mut self, name: &str, text: &str) {
        self.leaf_with(name, &[], text);
    }

    /// An element of text with attributes.
    pub fn leaf_with(&mut self, name: &str, attributes: &[(&str, String)], text: &str) {
        self.tag(name, attributes, ">");
        self.text.push_str(&format!("{}</{name}>\n", escaped(text)));
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
