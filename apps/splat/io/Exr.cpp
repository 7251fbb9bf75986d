#include "io/Exr.h"

#include "vorion/support/Printable.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <fmt/format.h>
#include <optional>
#include <stdexcept>
#include <vector>

namespace vorion::splat {
namespace {

/// A file in memory; the library reports what it cannot read by exceptions.
class BytesIn : public Imf::IStream {
public:
  explicit BytesIn(Bytes File) : IStream("picture"), File(File) {}

  bool read(char Into[], int Count) override {
    if (Count < 0 || At > File.size() ||
        static_cast<std::size_t>(Count) > File.size() - At)
      throw std::runtime_error("the file is truncated");
    std::memcpy(Into, File.data() + At, static_cast<std::size_t>(Count));
    At += static_cast<std::size_t>(Count);
    return At < File.size();
  }
  uint64_t tellg() override { return At; }
  void seekg(uint64_t To) override { At = To; }

private:
  Bytes File;
  uint64_t At = 0;
};

class BytesOut : public Imf::OStream {
public:
  BytesOut() : OStream("picture") {}

  void write(const char From[], int Count) override {
    const auto Size = static_cast<std::size_t>(Count);
    Text.resize(std::max<std::size_t>(Text.size(), At + Size));
    std::memcpy(Text.data() + At, From, Size);
    At += Size;
  }
  uint64_t tellp() override { return At; }
  void seekp(uint64_t To) override { At = To; }

  std::string Text;

private:
  uint64_t At = 0;
};

/// What stands for all three colours of a picture without them: a grey, or a
/// depth. Null if nothing does.
const char *loneChannel(const Imf::ChannelList &C) {
  if (C.findChannel("Y"))
    return C.findChannel("RY") || C.findChannel("BY") ? nullptr : "Y";
  return C.findChannel("Z") ? "Z" : nullptr;
}

/// What is wrong with the size of \p H's picture; nothing if it may be taken.
std::optional<std::string> sizeRefusal(const Imf::Header &H,
                                       std::size_t FileSize) {
  // What we make of it, and what the library does of all its channels.
  std::size_t Ours = 4 * sizeof(float), Theirs = 0;
  for (auto C = H.channels().begin(); C != H.channels().end(); ++C)
    Theirs += C.channel().type == Imf::HALF ? 2 : 4;
  for (const Imath::Box2i &Window : {H.displayWindow(), H.dataWindow()}) {
    const int64_t Width = int64_t{Window.max.x} - Window.min.x + 1;
    const int64_t Height = int64_t{Window.max.y} - Window.min.y + 1;
    if (Width < 1 || Height < 1 || Width > MaxPictureSide ||
        Height > MaxPictureSide)
      return fmt::format("{}x{} pixels, expected sides of 1 to {}", Width,
                         Height, MaxPictureSide);
    const std::size_t Size =
        std::max(Ours, Theirs) * static_cast<std::size_t>(Width * Height);
    if (Size > unpackLimit(FileSize))
      return fmt::format("{}x{} pixels in a file of {} bytes, expected at most "
                         "{} bytes unpacked",
                         Width, Height, FileSize, unpackLimit(FileSize));
  }
  return {};
}

/// What is wrong with the channels of \p H for a picture; nothing if it is one.
std::optional<std::string> channelRefusal(const Imf::Header &H) {
  std::string Names;
  for (auto C = H.channels().begin(); C != H.channels().end(); ++C)
    Names += (Names.empty() ? "" : ", ") + printable(C.name());
  for (const char *Name : {"R", "G", "B"})
    if (!H.channels().findChannel(Name) && !loneChannel(H.channels()))
      return fmt::format("channels {}, expected R, G and B, or Y or Z alone",
                         Names.empty() ? "none" : Names);
  for (const char *Name : {"R", "G", "B", "A", "Y", "Z"})
    if (const Imf::Channel *C = H.channels().findChannel(Name);
        C && (C->xSampling != 1 || C->ySampling != 1))
      return fmt::format(
          "channel {} is subsampled, expected one value per pixel", Name);
  return {};
}

/// What is wrong with the attributes that begin at \p At; nothing if the file
/// has all that they claim. The library would take memory for a claim first.
std::optional<std::string> attributeRefusal(Bytes File, std::size_t At) {
  const auto Text = [&] {
    const std::string_view Rest = asText(File.subspan(At));
    const std::string_view Found = Rest.substr(0, Rest.find('\0'));
    At = std::min(At + Found.size() + 1, File.size());
    return Found;
  };
  for (;;) {
    const std::string_view Name = Text();
    if (Name.empty() && At < File.size())
      return {};
    Text(); // of its type
    if (File.size() - At < sizeof(int32_t))
      return "truncated in its header, expected a complete picture";
    const auto Size = load<int32_t>(File, At);
    At += sizeof(Size);
    if (Size < 0 || static_cast<std::size_t>(Size) > File.size() - At)
      return fmt::format(
          "attribute {} has {} bytes, but {} are left, expected at most those",
          printable(Name), Size, File.size() - At);
    At += static_cast<std::size_t>(Size);
  }
}

/// What is wrong with the headers of \p File, found before anything is made of
/// them; nothing if the library may read it.
std::optional<std::string> refusal(Bytes File) {
  constexpr std::size_t Begin = 2 * sizeof(int32_t);
  constexpr int SeveralParts = 0x1000;
  if (File.size() < Begin)
    return "truncated in its header, expected a complete picture";
  int Version = load<int32_t>(File, sizeof(int32_t));
  BytesIn Stream(File);
  Stream.seekg(Begin);
  for (bool IsFirst = true;; IsFirst = false) {
    if (auto Why = attributeRefusal(File, Stream.tellg()))
      return Why;
    Imf::Header H;
    H.readFrom(Stream, Version);
    if (auto Why = sizeRefusal(H, File.size()))
      return Why;
    if (IsFirst)
      if (auto Why = channelRefusal(H))
        return Why;
    // An empty header is behind the last one.
    if ((Version & SeveralParts) == 0 || Stream.tellg() >= File.size() ||
        byteAt(File, Stream.tellg()) == 0)
      return {};
  }
}

/// A channel of the data window as floats.
struct ChannelPlane {
  const char *Name;
  std::vector<float> Values;
};

Expected<ExactImage> decode(const std::string &Where, Bytes Bytes) {
  if (const auto Why = refusal(Bytes))
    return Error{Where, *Why};
  BytesIn Stream(Bytes);
  Imf::InputFile File(Stream, /*numThreads=*/0);
  const Imf::Header &H = File.header();
  const Imath::Box2i &Shown = H.displayWindow(), &Data = H.dataWindow();
  const auto Across =
      static_cast<std::size_t>(int64_t{Data.max.x} - Data.min.x + 1);
  const auto Down =
      static_cast<std::size_t>(int64_t{Data.max.y} - Data.min.y + 1);
  const bool Coloured = H.channels().findChannel("R") != nullptr;
  std::vector<ChannelPlane> Planes;
  for (const char *Name : {"R", "G", "B", "A"}) {
    const bool IsAlpha = std::string_view(Name) == "A";
    if (!IsAlpha || H.channels().findChannel(Name))
      Planes.push_back({IsAlpha || Coloured ? Name : loneChannel(H.channels()),
                        std::vector<float>(Across * Down)});
  }
  Imf::FrameBuffer Buffer;
  for (ChannelPlane &P : Planes)
    if (!Buffer.findSlice(P.Name))
      Buffer.insert(P.Name,
                    Imf::Slice::Make(Imf::FLOAT, P.Values.data(), Data));
  File.setFrameBuffer(Buffer);
  File.readPixels(Data.min.y, Data.max.y);
  if (!Coloured)
    Planes[1].Values = Planes[2].Values = Planes[0].Values;

  ExactImage I;
  I.Width = Shown.max.x - Shown.min.x + 1;
  I.Height = Shown.max.y - Shown.min.y + 1;
  I.Render.resize(3 * I.pixels());
  if (Planes.size() == 4)
    I.Alpha.resize(I.pixels());
  std::size_t Pixel = 0;
  for (int Y = Shown.min.y; Y <= Shown.max.y; ++Y)
    for (int X = Shown.min.x; X <= Shown.max.x; ++X, ++Pixel) {
      if (X < Data.min.x || X > Data.max.x || Y < Data.min.y || Y > Data.max.y)
        continue;
      const std::size_t At = static_cast<std::size_t>(Y - Data.min.y) * Across +
                             static_cast<std::size_t>(X - Data.min.x);
      for (std::size_t K = 0; K < 3; ++K)
        I.Render[3 * Pixel + K] = Planes[K].Values[At];
      if (!I.Alpha.empty())
        I.Alpha[Pixel] = Planes[3].Values[At];
    }
  return I;
}

std::string encode(int Width, int Height,
                   const std::vector<ChannelPlane> &Planes, bool Half) {
  Imf::Header H(Width, Height);
  H.compression() = Imf::ZIP_COMPRESSION;
  Imf::addComments(H, "values as the scene has them, not converted");
  const Imf::PixelType Type = Half ? Imf::HALF : Imf::FLOAT;
  std::vector<std::vector<Imath::half>> Halves(Planes.size());
  Imf::FrameBuffer Buffer;
  const Imath::Box2i Window = H.dataWindow();
  for (std::size_t K = 0; K < Planes.size(); ++K) {
    const auto &[Name, Floats] = Planes[K];
    H.channels().insert(Name, Imf::Channel(Type));
    if (Half)
      Halves[K].assign(Floats.begin(), Floats.end());
    Buffer.insert(Name, Half ? Imf::Slice::Make(Type, Halves[K].data(), Window)
                             : Imf::Slice::Make(Type, Floats.data(), Window));
  }
  BytesOut Stream;
  {
    Imf::OutputFile File(Stream, H);
    File.setFrameBuffer(Buffer);
    File.writePixels(Height);
  }
  return std::move(Stream.Text);
}

} // namespace

Expected<ExactImage> decodeExr(const std::string &Where, Bytes File) {
  try {
    return decode(Where, File);
  } catch (const std::exception &E) {
    return Error{Where, fmt::format("not an OpenEXR picture ({}), expected a "
                                    "complete picture without deep data",
                                    printable(E.what()))};
  }
}

static Expected<std::string> encoded(int Width, int Height,
                                     const std::vector<ChannelPlane> &Planes,
                                     bool Half) {
  try {
    return encode(Width, Height, Planes, Half);
  } catch (const std::exception &E) {
    return Error{"",
                 fmt::format("cannot encode the picture as EXR ({})",
                             printable(E.what())),
                 ExitCode::LimitReached};
  }
}

Expected<std::string> encodeExr(const Image &I, bool Half) {
  std::vector<ChannelPlane> Planes;
  for (const char *Name : {"R", "G", "B"}) {
    const std::size_t K = Planes.size();
    std::vector<float> &Values =
        Planes.emplace_back(ChannelPlane{Name, {}}).Values;
    for (std::size_t P = 0; P < I.pixels(); ++P)
      Values.push_back(I.Render[3 * P + K]);
  }
  if (!I.Alpha.empty())
    Planes.push_back({"A", I.Alpha});
  return encoded(I.Width, I.Height, Planes, Half);
}

Expected<std::string> encodeExr(const DepthMap &D) {
  std::vector<ChannelPlane> Planes{{"Z", D.Depth}};
  if (!D.Alpha.empty())
    Planes.push_back({"A", D.Alpha});
  return encoded(D.Width, D.Height, Planes, /*Half=*/false);
}

} // namespace vorion::splat
