#include "capture/testing/CaptureWriters.h"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <turbojpeg.h>
#include <zlib.h>

namespace vorion::splat::testing {
namespace {

using Json = nlohmann::json;

template <typename T> void put(std::string &Out, T Value) {
  Out.append(reinterpret_cast<const char *>(&Value), sizeof(Value));
}

void putBig(std::string &Out, uint32_t Value) {
  for (const int Shift : {24, 16, 8, 0})
    Out += static_cast<char>(Value >> Shift & 0xFF);
}

void putChunk(std::string &Out, const std::string &Kind,
              const std::string &Content) {
  putBig(Out, static_cast<uint32_t>(Content.size()));
  const std::string Checked = Kind + Content;
  Out += Checked;
  putBig(Out, static_cast<uint32_t>(
                  crc32(0, reinterpret_cast<const Bytef *>(Checked.data()),
                        static_cast<uInt>(Checked.size()))));
}

void addPictures(Folder &F, const SampleCapture &C, const std::string &Where) {
  for (std::size_t I = 0; I < C.Views.size(); ++I) {
    std::string Rgba;
    for (int P = 0; P < C.Width * C.Height; ++P)
      Rgba += {static_cast<char>(20 * I), '\x40', static_cast<char>(P), '\xff'};
    F[Where + C.Views[I].Name] = pngOf(C.Width, C.Height, Rgba);
  }
}

/// COLMAP's number of the picture of \p V.
int32_t idOf(const SampleCapture &C, const SampleCapture::View &V) {
  return 100 + static_cast<int32_t>(&V - C.Views.data());
}

/// Camera to world with y up and z back, as transforms have it.
Json matrixOf(const SampleCapture::View &V) {
  const auto [W, X, Y, Z] = V.Quaternion;
  // Rows of the rotation, world to camera.
  const double R[3][3] = {
      {1 - 2 * (Y * Y + Z * Z), 2 * (X * Y - W * Z), 2 * (X * Z + W * Y)},
      {2 * (X * Y + W * Z), 1 - 2 * (X * X + Z * Z), 2 * (Y * Z - W * X)},
      {2 * (X * Z - W * Y), 2 * (Y * Z + W * X), 1 - 2 * (X * X + Y * Y)}};
  Json Matrix = Json::array();
  for (int I = 0; I < 3; ++I) {
    double Position = 0;
    for (int K = 0; K < 3; ++K)
      Position -= R[K][I] * V.Translation[static_cast<std::size_t>(K)];
    Matrix.push_back({R[0][I], -R[1][I], -R[2][I], Position});
  }
  Matrix.push_back({0, 0, 0, 1});
  return Matrix;
}

} // namespace

std::string pngOf(int Width, int Height, const std::string &Rgba) {
  std::string Header, Rows;
  putBig(Header, static_cast<uint32_t>(Width));
  putBig(Header, static_cast<uint32_t>(Height));
  Header += {'\x08', '\x06', '\0', '\0', '\0'};
  const auto Row = static_cast<std::size_t>(Width) * 4;
  for (int Y = 0; Y < Height; ++Y) {
    Rows += '\0'; // no filter
    Rows += Rgba.substr(static_cast<std::size_t>(Y) * Row, Row);
  }
  std::string Packed(compressBound(Rows.size()), '\0');
  uLongf Size = Packed.size();
  compress(reinterpret_cast<Bytef *>(Packed.data()), &Size,
           reinterpret_cast<const Bytef *>(Rows.data()), Rows.size());
  Packed.resize(Size);
  std::string Out = "\x89PNG\r\n\x1a\n";
  putChunk(Out, "IHDR", Header);
  putChunk(Out, "IDAT", Packed);
  putChunk(Out, "IEND", "");
  return Out;
}

std::string jpegOf(int Width, int Height, const std::string &Rgba) {
  tjhandle Compressor = tjInitCompress();
  unsigned char *Out = nullptr;
  unsigned long Size = 0;
  std::string Text;
  if (tjCompress2(Compressor,
                  reinterpret_cast<const unsigned char *>(Rgba.data()), Width,
                  0, Height, TJPF_RGBA, &Out, &Size, TJSAMP_444, 95, 0) == 0)
    Text.assign(reinterpret_cast<const char *>(Out), Size);
  tjFree(Out);
  tjDestroy(Compressor);
  return Text;
}

SampleCapture sampleCapture(std::size_t Views) {
  SampleCapture C;
  for (std::size_t I = 0; I < Views; ++I) {
    // Turned about y by the half angle; 3 in front of the origin.
    const double Half =
        3.14159265358979 * static_cast<double>(I) / static_cast<double>(Views);
    C.Views.push_back({fmt::format("a{}.png", I),
                       {std::cos(Half), 0, std::sin(Half), 0},
                       {0, 0, 3}});
  }
  for (std::size_t I = 0; I < 12; ++I) {
    C.Points.push_back(
        {{0.25 * static_cast<double>(I), 0.125 * static_cast<double>(I % 5),
          -0.5 * static_cast<double>(I % 3)},
         {static_cast<uint8_t>(I), static_cast<uint8_t>(20 * I), 255}});
    if (Views > 1)
      C.Points.back().SeenBy = {I % Views, (I + 1) % Views};
  }
  return C;
}

Folder colmapBinaryOf(const SampleCapture &C) {
  std::string Cameras, Images, Points;
  put<uint64_t>(Cameras, 1);
  put<int32_t>(Cameras, 7);
  put<int32_t>(Cameras, 1);
  put<uint64_t>(Cameras, static_cast<uint64_t>(C.Width));
  put<uint64_t>(Cameras, static_cast<uint64_t>(C.Height));
  for (const double V : {C.Fx, C.Fy, C.Cx, C.Cy})
    put(Cameras, V);
  put<uint64_t>(Images, C.Views.size());
  for (const auto &V : C.Views) {
    put(Images, idOf(C, V));
    for (const double Q : V.Quaternion)
      put(Images, Q);
    for (const double T : V.Translation)
      put(Images, T);
    put<int32_t>(Images, 7);
    Images += V.Name + '\0';
    put<uint64_t>(Images, 2);
    for (int I = 0; I < 6; ++I)
      put<uint64_t>(Images, 99);
  }
  put<uint64_t>(Points, C.Points.size());
  for (const auto &P : C.Points) {
    put<uint64_t>(Points, 5);
    for (const double X : P.Position)
      put(Points, X);
    for (const uint8_t B : P.Colour)
      put(Points, B);
    put(Points, 0.5);
    put<uint64_t>(Points, P.SeenBy.size());
    for (const std::size_t View : P.SeenBy) {
      put(Points, idOf(C, C.Views[View]));
      put<int32_t>(Points, 0);
    }
  }
  Folder F{{"sparse/0/cameras.bin", Cameras},
           {"sparse/0/images.bin", Images},
           {"sparse/0/points3D.bin", Points}};
  addPictures(F, C, "images/");
  return F;
}

Folder colmapTextOf(const SampleCapture &C) {
  std::string Images = "# image list\n", Points = "# points\n";
  for (const auto &V : C.Views)
    Images += fmt::format("{} {} {} {} {} {} {} {} 7 {}\n10 20 99 11 21 -1\n",
                          idOf(C, V), V.Quaternion[0], V.Quaternion[1],
                          V.Quaternion[2], V.Quaternion[3], V.Translation[0],
                          V.Translation[1], V.Translation[2], V.Name);
  for (const auto &P : C.Points) {
    Points +=
        fmt::format("5 {} {} {} {} {} {} 0.5", P.Position[0], P.Position[1],
                    P.Position[2], P.Colour[0], P.Colour[1], P.Colour[2]);
    for (const std::size_t View : P.SeenBy)
      Points += fmt::format(" {} 0", idOf(C, C.Views[View]));
    Points += '\n';
  }
  Folder F{{"sparse/0/cameras.txt",
            fmt::format("# cameras\n7 PINHOLE {} {} {} {} {} {}\r\n", C.Width,
                        C.Height, C.Fx, C.Fy, C.Cx, C.Cy)},
           {"sparse/0/images.txt", Images},
           {"sparse/0/points3D.txt", Points}};
  addPictures(F, C, "images/");
  return F;
}

Folder transformsOf(const SampleCapture &C) {
  Json J{{"fl_x", C.Fx},
         {"fl_y", C.Fy},
         {"cx", C.Cx},
         {"cy", C.Cy},
         {"w", C.Width},
         {"h", C.Height},
         {"k1", 0.0},
         {"camera_model", "OPENCV"},
         {"frames", Json::array()}};
  for (const auto &V : C.Views)
    J["frames"].push_back({{"file_path", "./pictures/" + V.Name},
                           {"transform_matrix", matrixOf(V)}});
  Folder F{{"transforms.json", J.dump(1)}};
  addPictures(F, C, "pictures/");
  return F;
}

std::string pointCloudOf(const SampleCapture &C) {
  std::string Ply = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "end_header\n",
      C.Points.size());
  for (const auto &P : C.Points) {
    for (const double X : P.Position)
      put(Ply, static_cast<float>(X));
    for (const uint8_t B : P.Colour)
      put(Ply, B);
  }
  return Ply;
}

Folder nerfSyntheticOf(const SampleCapture &C) {
  Json Train{{"camera_angle_x", 0.8}, {"frames", Json::array()}}, Test = Train;
  for (std::size_t I = 0; I < C.Views.size(); ++I) {
    const auto &V = C.Views[I];
    Json &To = I + 2 < C.Views.size() ? Train : Test;
    To["frames"].push_back(
        {{"file_path", "./all/" + V.Name.substr(0, V.Name.size() - 4)},
         {"transform_matrix", matrixOf(V)}});
  }
  Folder F{{"transforms_train.json", Train.dump(1)},
           {"transforms_test.json", Test.dump(1)}};
  addPictures(F, C, "all/");
  return F;
}

} // namespace vorion::splat::testing
