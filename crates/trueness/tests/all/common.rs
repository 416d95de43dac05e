//! What is asked of the request of every task.

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use std::fmt::Debug;

/// A request as JSON is read back as it was.
pub fn is_read_back<R: Serialize + DeserializeOwned + PartialEq + Debug>(request: &R) {
    let text = serde_json::to_string(request).unwrap();
    assert_eq!(&serde_json::from_str::<R>(&text).unwrap(), request);
}

/// A field that the request does not have is refused by its name; `asked` is a request.
pub fn refuses_what_it_lacks<R: DeserializeOwned + Debug>(mut asked: Value) {
    assert!(serde_json::from_value::<R>(asked.clone()).is_ok());
    asked["no_field_of_it"] = json!(1);
    let said = serde_json::from_value::<R>(asked).unwrap_err().to_string();
    assert!(said.contains("no_field_of_it"), "{said}");
}
