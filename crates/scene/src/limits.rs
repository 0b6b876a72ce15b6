//! Every bound on what a file may ask for. A message about a limit names the number it broke.

/// Largest file that is read, bytes.
pub const FILE_BYTES: u64 = 1 << 30;
/// Largest YAML file that is read, bytes.
pub const YAML_BYTES: u64 = 4 << 20;
/// Largest file that keeps unsaved muscles for recovery, bytes: it holds several muscle files.
pub const RECOVERY_BYTES: u64 = 4 * YAML_BYTES;
/// Most values of one YAML text, aliases counted as often as they are used.
pub const YAML_VALUES: usize = 125_000;
/// Most signs of YAML (brackets, commas, colons, quotes and the like) in a text of [`YAML_BYTES`], in comments and texts too; as many more where more bytes
/// are let in. The parser looks ahead to the end of a list in brackets before it tells what is in it.
pub const YAML_SIGNS: usize = 125_000;
/// Most lines of a YAML text that begin with `%`.
pub const YAML_DIRECTIVES: usize = 64;
/// Most bytes that the texts of one YAML file have together, aliases counted as often as they are used.
pub const YAML_TEXT: usize = 16 << 20;
/// Deepest nesting of YAML, through aliases too.
pub const YAML_DEPTH: usize = 100;
/// Most files that one session or muscle file may bring into a scene.
pub const SESSION_FILES: usize = 100;
/// Whether the system would give so many bytes now. A library that runs out of memory ends the program, so the memory is asked for before.
pub fn is_room(bytes: u64) -> bool {
    usize::try_from(bytes).is_ok_and(|bytes| Vec::<u8>::new().try_reserve_exact(bytes).is_ok())
}

/// Largest image file that is read, bytes.
pub const IMAGE_BYTES: u64 = 256 << 20;
/// Largest side of an image, pixels.
pub const IMAGE_SIDE: u32 = 16_384;
/// What all images of a document take together at most once they are drawn, mip levels included, bytes. Beyond it they are made smaller.
pub const IMAGES_BYTES: u64 = 512 << 20;
/// What decoding one image may take beside the picture that comes out, bytes.
pub const IMAGE_DECODING_BYTES: u64 = 512 << 20;
/// What decoding one image may take where it is only tested, bytes: less than what reading a file may take beside ten times its size.
pub const IMAGE_TESTING_BYTES: u64 = 32 << 20;
/// Pixels that are decoded at most to test the images of a document: about a second.
pub const IMAGES_TESTED: u64 = 64 << 20;
/// Deepest nesting of elements or nodes.
pub const DEPTH: usize = 1_000;
/// Most attributes of one XML element; the parser compares each with each.
pub const XML_ATTRIBUTES: usize = 64;
/// Most namespace prefixes that an XML document declares; each element that declares one copies all that hold around it.
pub const XML_PREFIXES: usize = 64;
/// Most bytes that the entities of an XML document may expand to.
pub const ENTITY_BYTES: usize = 16 << 20;
/// What the tree of a document and the scene made from its references may take together, on top of [`READ_BYTES_PER_BYTE`] times its size.
pub const READ_BYTES: usize = 48 << 20;
/// What the same may take for each byte of the document.
pub const READ_BYTES_PER_BYTE: usize = 9;
/// Most findings that are kept about one file.
pub const FINDINGS: usize = 1_000;
/// How deep morph targets may be controllers with morph targets of their own.
pub const MORPH_DEPTH: usize = 32;
/// Most sets of texture coordinates of a mesh.
pub const UV_SETS: usize = 8;
/// Most steps that cutting the polygons of one file into triangles may take.
pub const TRIANGULATION_STEPS: u64 = 1_000_000_000;
/// Most files in an archive.
pub const ARCHIVE_FILES: usize = 4_096;
/// What an archive, its unpacked files and everything that is made of them may take together, bytes, on top of [`ARCHIVE_BYTES_PER_BYTE`]
/// times its size. A plain document gets by with the same; in an archive it has to be seen to, since what is packed says little of how large it is.
pub const ARCHIVE_BYTES: usize = 64 << 20;
/// What the same may take for each byte of the archive.
pub const ARCHIVE_BYTES_PER_BYTE: usize = 10;
/// What a number of a list takes at most once it is in a mesh or curve, bytes.
pub const BYTES_PER_NUMBER: usize = 12;
/// Most nodes in a scene, instances counted.
pub const NODES: usize = 1_000_000;
/// What drawing the instances of a file takes at most, the first of each mesh not counted, bytes.
pub const INSTANCES_BYTES: usize = 512 << 20;
/// What converting a document to glTF takes at most beside the document, bytes.
pub const CONVERTED_BYTES: usize = 1 << 30;
/// Most nodes of one muscle.
pub const MUSCLE_NODES: usize = 10_000;
/// Most measured poses of one muscle.
pub const MUSCLE_POSES: usize = 1_000;
/// Most muscles in one file.
pub const MUSCLES: usize = 1_000;
/// Most joints that a muscle file names.
pub const JOINTS: usize = 64;
/// Most vertices that the surfaces of all muscles of a document have together: nodes times muscles times the corners of a ring.
pub const MUSCLE_VERTICES: usize = 2_000_000;
/// Most vertices of all shapes together that muscles are kept in when a document is converted; each takes 24 bytes.
pub const SHAPE_VERTICES: usize = 12_000_000;
/// Largest side of a picture, pixels.
pub const PICTURE_SIDE: u32 = 16_384;
/// Most worker threads of the renderer.
pub const THREADS: usize = 256;
/// Most rows of a table over time, all joints or muscles together.
pub const TABLE_ROWS: usize = 4_000_000;
