# capture-command.sh FAKES SCRATCH SAMPLES: runs `splat capture` with the programs of FAKES in the places of COLMAP and ffmpeg.
# Prints what each run says, behind a line with its name.
fakes=$1 samples=$3/captures/colmap-binary/images
cd "$2" || exit 1
theirs=$PATH
export PATH="$fakes:$PATH" FAKE_CALLS=$2/calls FAKE_FRAME=$2/photos/a0.png

# try NAME [VARIABLE=VALUE...] ARGUMENTS...: a run of splat capture, its exit code, and what COLMAP was called for.
try() {
  : >calls
  echo "== $1"
  shift
  env "$@" 2>&1
  echo "exit $?; calls: $(tr '\n' ' ' <calls)"
}

mkdir -p photos/b photos/masks heic
cp "$samples"/a[0-6].png photos
cp "$samples"/a7.png photos/b
cp photos/a0.png photos/masks/a1.png
echo nothing | tee photos/notes.txt >heic/IMG_1.HEIC
mkdir bare && ln -s "$(PATH=$theirs command -v splat)" bare/splat

try missing PATH="$PWD/bare" splat capture photos -o none
try interrupted FAKE_STOP=feature_extractor:3 splat capture photos -o made
try later FAKE_STOP=mapper:5 splat capture photos -o made
grep Processed made/colmap/feature_extractor.log
try continued splat capture photos -o made
cmp made/masks/a1.png.png photos/a0.png
splat info made
try complete splat capture photos -o made
cp "$samples"/a8.png photos
try added splat capture photos -o made
grep Processed made/colmap/feature_extractor.log
try differ splat capture photos -o made --cameras-differ
grep -c Processed made/colmap/feature_extractor.log

try parts FAKE_MODELS=3,5 FAKE_ERROR=1.4 splat capture photos -o parts
splat info parts
try failed FAKE_FAIL=mapper splat capture photos -o failed

try inside splat capture photos -o photos/made
try nothing splat capture nothing -o x
try few splat capture photos/masks -o x
try heic splat capture heic -o x2
try other splat capture "$samples" -o made
try one splat capture photos/a0.png -o x3

python3 -c "[print(n * 9 if n < 40 else 351, 'sharp' if n % 4 == 1 else 'blurred') for n in range(48)]" >clip.mp4
try film splat capture clip.mp4 -o film --frames 12
ls film/images
try again FAKE_FAIL=ffmpeg splat capture clip.mp4 -o film --frames 12
try damaged FAKE_FAIL=ffmpeg splat capture clip.mp4 -o film2
