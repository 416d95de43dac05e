//! Readers and writers of meshes and point clouds.
