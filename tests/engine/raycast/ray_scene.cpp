// SPDX-License-Identifier: GPL-3.0-or-later
// What a ray meets, and what is nearest, does not depend on the number of threads: rays at vertices
// and edges, where several triangles are equally far.
#include "raycast/ray_scene.h"

#include <algorithm>
#include <limits>
#include <mutex>
#include <random>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/engine/mesh_distance.h"

#include "support/shapes.h"

namespace argil {
namespace {

/// A torus that no axis helps, of 80 000 triangles.
TriangleMesh turned_torus() {
  TriangleMesh mesh = test::torus_mesh(10.0, 4.0, 200, 200);
  const Quat q = normalized(Quat{0.9, 0.3, -0.5, 0.2});
  for (Vec3& p : mesh.positions) p = rotate(q, p);
  return mesh;
}

struct Ray {
  Vec3 origin;
  Vec3 direction;
};

/// From above at vertices and middles of edges of the torus.
std::vector<Ray> rays_at(const TriangleMesh& mesh) {
  std::vector<Ray> rays;
  const Vec3 eye{3.0, -5.0, 60.0};
  for (std::size_t n = 0; n < mesh.triangles.size(); n += 2) {
    const Triangle& t = mesh.triangles[n];
    const Vec3& a = mesh.positions[t[0]];
    rays.push_back({eye, normalized(a - eye)});
    rays.push_back({eye, normalized(0.5 * (a + mesh.positions[t[1]]) - eye)});
  }
  return rays;
}

std::vector<std::pair<std::uint32_t, double>> answers(const TriangleMesh& mesh,
                                                      const std::vector<Ray>& rays) {
  const RayScene scene = RayScene::build(mesh).value();
  std::vector<std::pair<std::uint32_t, double>> found;
  for (const Ray& ray : rays) {
    const auto hit = scene.closest(ray.origin, ray.direction);
    found.emplace_back(hit ? hit->triangle : kNoTriangle, hit ? hit->distance : 0.0);
  }
  return found;
}

TEST(RayScene, IsBuiltByOneThread) {
  const TriangleMesh torus = test::torus_mesh(10.0, 4.0, 300, 300);
  std::mutex mutex;
  std::set<std::thread::id> builders;
  const auto scene = RayScene::build(torus, [&](double) {
    const std::lock_guard lock(mutex);
    builders.insert(std::this_thread::get_id());
    return true;
  });
  ASSERT_TRUE(scene.ok());
  EXPECT_EQ(builders, std::set{std::this_thread::get_id()});
}

TEST(RayScene, AnswersAlikeForAnyThreadCount) {
  const TriangleMesh torus = turned_torus();
  const std::vector<Ray> rays = rays_at(torus);
  const auto first = answers(torus, rays);
  EXPECT_LT(std::ranges::count(first, kNoTriangle, &std::pair<std::uint32_t, double>::first),
            static_cast<std::ptrdiff_t>(rays.size() / 10));
  for (const std::size_t threads : {1U, 2U, 7U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_TRUE(answers(torus, rays) == first) << threads;
  }
}

/// The same with some triangles far away, so that its tree is another.
TriangleMesh with_more(TriangleMesh mesh, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-30.0, 30.0);
  for (int n = 0; n < 500; ++n) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const Vec3 at{place(random), place(random), -200.0 + place(random)};
    for (const Vec3& corner : {Vec3{}, Vec3{1.0, 0.0, 0.2}, Vec3{0.0, 1.0, 0.1}}) {
      mesh.positions.push_back(at + corner);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// Points on the axis of a ring and around, from which many triangles are equally near.
std::vector<MeshDistance::Closest> nearest_to(const TriangleMesh& mesh) {
  const MeshDistance distance(mesh.positions, mesh.triangles);
  std::vector<MeshDistance::Closest> found;
  for (int n = -20; n <= 20; ++n) {
    for (int m = -20; m <= 20; ++m) {
      found.push_back(distance.closest({0.5 * n, 0.5 * m, 0.25 * (n - m)},
                                       std::numeric_limits<double>::infinity()));
    }
  }
  for (std::size_t n = 0; n < 12'000; n += 7) {
    // A vertex is as near on all its triangles.
    found.push_back(distance.closest(mesh.positions[n], 1.0));
  }
  return found;
}

void expect_alike(const std::vector<MeshDistance::Closest>& a,
                  const std::vector<MeshDistance::Closest>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t n = 0; n < a.size(); ++n) {
    ASSERT_EQ(a[n].triangle, b[n].triangle) << n;
    ASSERT_EQ(a[n].distance, b[n].distance) << n;
    ASSERT_EQ(a[n].point, b[n].point) << n;
  }
}

TEST(MeshDistance, AnswersAlikeWhateverItsTreeAndForAnyThreadCount) {
  const TriangleMesh torus = test::torus_mesh(10.0, 4.0, 200, 200);
  const auto first = nearest_to(torus);
  expect_alike(nearest_to(with_more(torus, 1)), first);
  for (const std::size_t threads : {1U, 2U, 7U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    expect_alike(nearest_to(torus), first);
  }
}

}  // namespace
}  // namespace argil
