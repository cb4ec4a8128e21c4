// Files that are not read: what they are, and the way out.

/** How files begin, in Latin-1. */
const BEGINNINGS: readonly (readonly [begins: RegExp, says: string])[] = [
  [/^PK\x03\x04/, "it is a ZIP archive; unpack it, and read the file in it"],
  [/^(7z\xbc\xaf|Rar!)/, "it is an archive; unpack it, and read the file in it"],
  [/^(BZh|\xfd7zXZ|\x28\xb5\x2f\xfd)/, "it is packed, but not with gzip; unpack it first"],
  [/^[^]{257}ustar/, "it is a TAR archive; unpack it, and read the file in it"],
  [/^(\xff\xd8\xff|\x89PNG|GIF8|RIFF[^]{4}WEBP|II\*\0|MM\0\*)/, "it is an image; images have no points"],
  [/^%PDF/, "it is a PDF document"],
  [/^\x93NUMPY/, "it is an array of NumPy; save its x, y and z as text (numpy.savetxt), PLY or LAS"],
  [/^(pnts|b3dm|i3dm|cmpt)/, "it is a tile of 3D Tiles; read the file from which the tiles were made"],
  [/^\x89HDF/, "it is an HDF5 file; export its points as PLY, LAS or text"],
  [/^#ROSBAG/, "it is a bag of ROS; export its clouds as PCD"],
  [/^(\xd4\xc3\xb2\xa1|\xa1\xb2\xc3\xd4|\x0a\x0d\x0d\x0a)/, "it is a capture of network packets; export its points as PCD, LAS or text"],
  [/^PAR1/, "it is a Parquet file; export its points as text"],
  [/^SQLite format 3/, "it is a database of SQLite"],
  [/^Kaydara FBX/, "it is an FBX file; export it as glTF, PLY or OBJ"],
  [/^DRACO/, "it is compressed with Draco; export it without that compression"],
  [/^\s*solid\b[^]*\bfacet\b/, "it is an STL file; export it as PLY or OBJ"],
  [/^\s*<(\?xml|!DOCTYPE|html)/i, "it is XML or a page of the web, and no points"],
  [/^\s*\{[^]*"dataType"\s*:\s*"(laszip|binary|zstandard)"/, "it is the index of an EPT octree; read one LAZ file of its folder ept-data, or convert it to COPC"],
  [/^\s*\{[^]*"(hierarchy|octreeDir|firstChunkSize)"/, "it is the index of a Potree octree; openOctree of hidden-point-removal/stream reads it"],
  [/^\s*\[\s*\{[^]*"img_name"/, "it holds the cameras of Gaussian splats, and no points; readCameras reads it"],
  [/^\s*\{[^]*"(frames|camera_angle_x)"/, "it holds cameras, and no points; readCameras reads it"],
  [/^\s*\{[^]*"asset"[^]*"version"/, "it is a glTF file; its name must end with .gltf"],
  [/^\s*[[{]/, "it is JSON, which has no points that are read"],
]; // prettier-ignore

/** What a file is that no reader of points takes. Undefined if it may be text. */
export function foreignFile(start: string): string | undefined {
  return BEGINNINGS.find(([begins]) => begins.test(start))?.[1];
}
