//! XML documents, element after element.

/// A document, or a part of one, under construction: each element begins a line, indented by its depth.
///
/// Texts and values of attributes are escaped; characters that XML 1.0 cannot hold become U+FFFD. Names are taken as they are.
pub struct Xml {
    text: String,
    /// Names of the elements that are not ended.
    open: Vec<String>,
    /// Blanks for each level.
    indent: usize,
    /// Levels above the outermost element.
    depth: usize,
    /// Whether elements stay on the line on which they are.
    in_line: bool,
}

/// Names and values of attributes, in their order.
pub type Attributes<'a> = &'a [(&'a str, String)];

impl Xml {
    /// A document with so many blanks for each level.
    pub fn new(indent: usize) -> Xml {
        Xml::part(indent, 0)
    }

    /// A part of a document, `depth` levels deep, for [`Xml::push`].
    pub fn part(indent: usize, depth: usize) -> Xml {
        Xml { text: String::new(), open: vec![], indent, depth, in_line: false }
    }

    /// The first line of a document, which says its version and what else is given.
    pub fn declaration(&mut self, attributes: Attributes) {
        self.text.push_str("<?xml version=\"1.0\"");
        self.attributes(attributes);
        self.text.push_str("?>\n");
    }

    /// The beginning of an element.
    pub fn start(&mut self, name: &str, attributes: Attributes) {
        self.tag(name, attributes, ">");
        self.end_line();
        self.open.push(name.into());
    }

    /// The end of the element that was begun last.
    pub fn end(&mut self) {
        if let Some(name) = self.open.pop() {
            self.begin_line();
            self.text.push_str(&format!("</{name}>"));
            self.end_line();
        }
    }

    /// An element with what `inside` writes.
    pub fn element(&mut self, name: &str, attributes: Attributes, inside: impl FnOnce(&mut Xml)) {
        self.start(name, attributes);
        inside(self);
        self.end();
    }

    /// An element that stands on one line with what `inside` writes.
    pub fn line(&mut self, name: &str, attributes: Attributes, inside: impl FnOnce(&mut Xml)) {
        self.begin_line();
        let before = std::mem::replace(&mut self.in_line, true);
        self.element(name, attributes, inside);
        self.in_line = before;
        self.end_line();
    }

    /// An element without content.
    pub fn empty(&mut self, name: &str, attributes: Attributes) {
        self.tag(name, attributes, "/>");
        self.end_line();
    }

    /// An element of text.
    pub fn leaf(&mut self, name: &str, attributes: Attributes, text: &str) {
        self.tag(name, attributes, ">");
        push_escaped(&mut self.text, text);
        self.text.push_str(&format!("</{name}>"));
        self.end_line();
    }

    /// Adds a part of the document, see [`Xml::part`].
    pub fn push(&mut self, part: &str) {
        self.text.push_str(part);
    }

    /// The text written since the last call; the elements that are open stay so.
    pub fn take(&mut self) -> String {
        std::mem::take(&mut self.text)
    }

    fn tag(&mut self, name: &str, attributes: Attributes, end: &str) {
        self.begin_line();
        self.text.push('<');
        self.text.push_str(name);
        self.attributes(attributes);
        self.text.push_str(end);
    }

    fn attributes(&mut self, attributes: Attributes) {
        for (key, value) in attributes {
            self.text.push_str(&format!(" {key}=\""));
            push_escaped(&mut self.text, value);
            self.text.push('"');
        }
    }

    fn begin_line(&mut self) {
        if !self.in_line {
            let blanks = self.indent * (self.depth + self.open.len());
            self.text.extend(std::iter::repeat_n(' ', blanks));
        }
    }

    fn end_line(&mut self) {
        if !self.in_line {
            self.text.push('\n');
        }
    }
}

/// Text as it stands between tags and in attributes.
fn push_escaped(out: &mut String, text: &str) {
    out.reserve(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\n' => out.push_str("&#10;"),
            '\t' => out.push_str("&#9;"),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_text_breaks_out_of_its_element_or_attribute() {
        let mut xml = Xml::new(0);
        let foreign = "<a b=\"c\">&\u{1}\n";
        let safe = "&lt;a b=&quot;c&quot;&gt;&amp;\u{fffd}&#10;";
        xml.leaf("l", &[("k", foreign.into())], foreign);
        assert_eq!(xml.take(), format!("<l k=\"{safe}\">{safe}</l>\n"));
    }

    #[test]
    fn elements_are_indented_by_their_depth() {
        let mut part = Xml::part(2, 1);
        part.element("b", &[], |x| x.empty("c", &[]));
        let mut xml = Xml::new(2);
        xml.declaration(&[("encoding", "UTF-8".into())]);
        xml.start("a", &[("n", "1".into()), ("m", String::new())]);
        xml.line("d", &[], |x| {
            x.empty("e", &[]);
            x.leaf("f", &[], "g");
        });
        xml.push(&part.take());
        assert_eq!(
            xml.take(),
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<a n=\"1\" m=\"\">\n  <d><e/><f>g</f></d>\n  <b>\n    <c/>\n  </b>\n"
        );
        xml.end();
        xml.end();
        assert_eq!(xml.take(), "</a>\n");
    }
}
