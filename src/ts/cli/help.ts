import { TRANSFER_FLAGS, VIEW_FLAGS } from "./flags.js";

function lines(flags: readonly (readonly [name: string, value: string, about: string])[]): string {
  return flags.map(([name, value, about]) => wrapped(`  --${name} ${value}`, about)).join("\n");
}

/** Both columns; no line is longer than 100 characters. */
function wrapped(left: string, right: string): string {
  return right
    .match(/.{1,76}(?: |$)/g)!
    .map((line, i) => (i === 0 ? left : "").padEnd(23) + line.trimEnd())
    .join("\n");
}

export const HELP = `Usage: hidden-point-removal IN --from X,Y,Z -o OUT [options]
       hidden-point-removal IN --cameras CAMERA.json --format pixels -o OUT.csv
       hidden-point-removal IN --viewpoints PLACES.csv [--coverage] -o OUT
       hidden-point-removal IN --images DIR --cameras FILE -o COLORED.ply

Writes those points of a file that can be seen, or their indices, a mask, their pixels
in an image, from how many places or by which cameras each point is seen, or its color.

  IN                   a LAS, LAZ, COPC, E57, PTX, PLY, PCD, XYZ, TXT, CSV or PTS file,
                       also packed (.gz)
  --columns X,Y,Z      which columns of IN are x, y and z: their names or numbers from 1

From where (one of the three, in the coordinates of the file):
  --from X,Y,Z         one viewpoint
  --viewpoints FILE    many viewpoints: a table with the columns x,y,z or name,x,y,z; or cameras
                       (a folder, or an ending .json, .yaml or .bin)
  --cameras FILE       one or many cameras: a JSON object with cameraToWorld, fx, fy, cx, cy, width,
                       height and, if needed, model, distortion, near, far, or a list of such, each
                       with the name of its "image"; COLMAP's folder with cameras and images;
                       transforms.json of nerfstudio; calib.txt of KITTI; YAML of OpenCV and ROS
  --images DIR         with --cameras: the folder of their images. Each point gets the color
                       that the cameras see there (needs sharp: npm install sharp)
${lines(TRANSFER_FLAGS)}

How (the defaults fit most clouds):
${lines(VIEW_FLAGS)}
  --score-threshold T  with looks: the points whose score is at least T, from 0 to 1

What to write:
  -o, --output OUT     the file to write; - is standard output. With --viewpoints or --cameras, a
                       name with {name} in it is one file for each; without, OUT holds what any
                       of them sees
  --coverage           with --viewpoints or --cameras: how many of them see each point
  --format F           points (a file like IN, or PLY or LAS), indices, mask, scores (with looks), pixels
                       (index, u, v, depth; of one camera, or with {name}), counts (with --coverage), colors
                       (with --images: a PLY file of all points with their colors and "seen", the
                       number of cameras; or a table) or vis (with --cameras: COLMAP's file of
                       which images see each point, OUT.vis). The default follows from OUT: an
                       ending like IN's is points, .idx indices, .mask and .npy a mask
                       All but points are text, one line each, or NumPy arrays (.npy)
  --overwrite          OUT may be the same file as IN, CAMERA or PLACES
  --damaged            reads a file that contradicts itself, and says how
  --workers N          how many workers share many viewpoints, from 1 to 64; they change no answer. The
                       default is one for each core from 200,000 points on, but no more than hold
                       16 million points together, and 1 for smaller files
  --progress           reports the progress, also if standard error is not a terminal
  -h, --help           shows this
  --version            shows the version

Without --columns, the columns named x, y and z (or easting, northing and height) are
read. In a file without names, the first three columns are read. At the end, the command
says which columns it has read. A file that breaks the rules of its format is refused,
with the number of the line.

All values of a point (color, normal, any property) are copied unchanged. Of a PLY file,
only the vertices are kept. Compressed PCD data is written uncompressed, and LAZ and COPC
files are written as LAS. Points without a position (NaN) are never visible. Indices count
from 0, in the order of the file.

Exit codes: 0 done, 1 a file could not be read, written or understood, 2 wrong usage
`;
