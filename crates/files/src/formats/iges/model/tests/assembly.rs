//! Subfigures and where they stand.

use super::super::super::written::{Text, list};
use super::solids::solid_box;
use super::{measured, near, read};

const TURNED: [f64; 12] = [0.0, -1.0, 0.0, 100.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 7.0];

#[test]
fn subfigures_stand_where_their_instances_say() {
    let mut text = Text::new();
    let solid = solid_box(&mut text, &[]);
    let inner = text.add(308, format!("0,3HBOX,1,{solid}"));
    let near_one = text.add(408, format!("{inner},0.,0.,0.,1."));
    let far_one = text.add(408, format!("{inner},10.,0.,0.,2."));
    let outer = text.add(308, format!("1,4HPAIR,2,{near_one},{far_one}"));
    let at = text.add(124, list(TURNED));
    let _ = text.add(408, format!("{outer},0.,5.,0."));
    text.placed(at);
    let found = measured(&text);
    let model = &found.file.model;
    assert_eq!((model.parts.len(), model.instances.len(), model.depth), (1, 2, 2));
    let paths: Vec<String> = model.instances.iter().map(|i| i.path.join("/")).collect();
    assert_eq!(paths, ["test/PAIR/BOX", "test/PAIR/BOX"]);
    assert!(near(found.volume, 24.0 * 9.0));
    // The second box: doubled and moved by 10 along x, then by 5 along y, then turned about z and moved.
    let [min, max] = [found.bounds.min, found.bounds.max];
    assert!(near(min[0], 100.0 - 11.0) && near(max[0], 95.0), "{min:?} {max:?}");
    assert!(
        near(min[1], 0.0) && near(max[1], 14.0) && near(min[2], 7.0) && near(max[2], 15.0),
        "{min:?} {max:?}"
    );
}

/// Network subfigures (320, 420) are placed alike; shapes beside them belong to the root.
#[test]
fn shapes_beside_subfigures_belong_to_the_root() {
    let mut text = Text::new();
    let solid = solid_box(&mut text, &[]);
    let network = text.add(320, format!("0,3HNET,1,{solid},1,2HR1,0,0,0"));
    text.add(420, format!("{network},1.,2.,3.,2.,,,1,2HU1,0,0"));
    let center = text.add(116, "0.,0.,0.,0");
    text.add(196, format!("{center},1."));
    let model = measured(&text).file.model;
    assert_eq!((model.parts.len(), model.instances.len()), (2, 2));
    assert_eq!((model.parts[0].brep.faces.len(), model.parts[1].brep.faces.len()), (1, 6));
}

#[test]
fn what_is_placed_nowhere_or_in_itself_is_told() {
    let mut text = Text::new();
    let solid = solid_box(&mut text, &[]);
    let inner = text.add(308, format!("0,3HBOX,1,{solid}"));
    // The next but one places the next.
    let own = inner + 2;
    let outer = text.add(308, format!("1,4HSELF,2,{},{}", own + 2, own + 4));
    assert_eq!(outer, own);
    text.add(408, format!("{outer},0.,0.,0.,1."));
    text.add(408, format!("{inner},0.,0.,0.,1."));
    text.add(408, format!("{outer},0.,0.,0.,1."));
    let file = read(&text);
    assert_eq!(file.model.instances.len(), 1);
    assert!(file.model.unread.iter().any(|u| u.reason.contains("in itself")), "{:?}", file.model.unread);
    let mut text = Text::new();
    solid_box(&mut text, &[]);
    let center = text.add(116, "0.,0.,0.,0");
    let ball = text.add(196, format!("{center},1."));
    text.add(308, format!("0,4HBALL,1,{ball}"));
    let file = read(&text);
    assert!(file.model.is_complete() && file.model.unread.len() == 1, "{:?}", file.model.unread);
    assert!(file.model.unread[0].reason.contains("placed nowhere"));
}
