//! x
fn main() {
    let mut names: Vec<_> = std::fs::read_dir("scenes")
        .unwrap()
        .map(|e| e.unwrap().path())
        .filter(|p| p.extension().is_some_and(|e| e == "toml"))
        .collect();
    names.sort();
    for path in names {
        let scene = dbd_scene::Scene::load(&path).unwrap();
        match scene.reduced() {
            Ok(p) => println!(
                "{:30} planar {}: {} -> {} elements, {} points -> {}, at rest {:?}",
                path.display(),
                p.plane.name(),
                scene.model.tsda_count(),
                p.model.tsda_count(),
                scene.model.points.len(),
                p.model.points.len(),
                p.at_rest.len()
            ),
            Err(u) => println!(
                "{:30} no {}: {} : {}",
                path.display(),
                u.plane,
                u.departures.len(),
                u.departures[0].text(&scene)
            ),
        }
    }
}
