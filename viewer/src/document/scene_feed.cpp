// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/scene_feed.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include "picture/piece_frame.h"

namespace argil::viewer {

void SceneNews::append(SceneNews&& later) {
  for (const PieceKey key : later.gone) pieces.erase(key);
  gone.insert(gone.end(), later.gone.begin(), later.gone.end());
  for (auto& [key, news] : later.pieces) pieces[key].append(std::move(news));
}

SceneFeed::Followed& SceneFeed::follow(const Clay& clay) {
  const auto [known, is_new] = followed_.try_emplace(&clay);
  if (is_new) known->second.key = next_key_++;
  return known->second;
}

PieceKey SceneFeed::key_of(const Sculpture& sculpture, std::size_t n) {
  const Clay& clay = sculpture.clay(n);
  // One that came meanwhile may have been there before.
  if (!followed_.contains(&clay)) forget_gone(sculpture);
  return follow(clay).key;
}

void SceneFeed::touch_masks() noexcept {
  for (auto& [clay, followed] : followed_) followed.feed.touch_mask_everywhere();
}

void SceneFeed::restart() noexcept {
  for (auto& [clay, followed] : followed_) followed.feed.restart();
  is_fresh_ = true;
}

SceneNews SceneFeed::drop_all() {
  gone_.reserve(gone_.size() + followed_.size());  // all of them, or none is forgotten yet
  for (const auto& [clay, followed] : followed_) gone_.push_back(followed.key);
  followed_.clear();
  former_.clear();
  is_fresh_ = true;
  SceneNews news;
  news.gone = std::exchange(gone_, {});
  return news;
}

void SceneFeed::forget_gone(const Sculpture& sculpture) {
  std::map<const Clay*, std::size_t> here;
  for (std::size_t n = 0; n < sculpture.piece_count(); ++n) here[&sculpture.clay(n)] = n;
  for (auto at = followed_.begin(); at != followed_.end();) {
    if (const auto found = here.find(at->first); found != here.end()) {
      at->second.name = sculpture.look(found->second).name;
      ++at;
    } else {
      // Last what cannot be done twice, should there be no memory for the other.
      former_[at->first] = {at->second.key, at->second.name};
      gone_.push_back(at->second.key);
      at = followed_.erase(at);
    }
  }
  for (const auto& [clay, n] : here) {
    if (!followed_.contains(clay)) take_back_key(*clay, sculpture.look(n).name);
  }
}

/// Follows a piece that was not there before by the key that it had, if it ever had one.
void SceneFeed::take_back_key(const Clay& clay, const std::string& name) {
  const auto known = former_.find(&clay);
  const bool is_back = known != former_.end() && known->second.name == name;
  Followed& followed = follow(clay);
  followed.name = name;
  if (is_back) followed.key = known->second.key;
  former_.erase(&clay);
}

Result<SceneNews> SceneFeed::update(const Sculpture& sculpture, const ViewOf& view_of,
                                    bool looks_at_all) {
  SceneNews news;
  looks_at_all = std::exchange(is_fresh_, false) || looks_at_all;
  if (looks_at_all) forget_gone(sculpture);
  for (std::size_t n = 0; n < sculpture.piece_count(); ++n) {
    const PieceLook& look = sculpture.look(n);
    if (!look.is_visible || (!looks_at_all && n != sculpture.active())) continue;
    const Clay& clay = sculpture.clay(n);
    std::optional<DisplayView> view = view_of(clay);
    if (view) view = unplaced(look.placement, *view);
    Followed& followed = follow(clay);
    auto updated = followed.feed.update(clay, view);
    if (!updated) {
      restart();
      return updated.error();
    }
    if (!updated.value().empty()) news.pieces.emplace(followed.key, std::move(updated).value());
  }
  news.gone = std::exchange(gone_, {});
  return news;
}

Result<SceneNews> SceneFeed::update(const Sculpture& sculpture, Preview& preview) {
  Followed& followed = follow(sculpture.clay());
  auto updated = followed.feed.update(sculpture.clay(), preview);
  if (!updated) return updated.error();
  SceneNews news;
  if (!updated.value().empty()) news.pieces.emplace(followed.key, std::move(updated).value());
  return news;
}

std::optional<ScenePick> SceneFeed::pick(const Sculpture& sculpture, const Ray& ray) {
  std::optional<ScenePick> nearest;
  for (std::size_t n = 0; n < sculpture.piece_count(); ++n) {
    const PieceLook& look = sculpture.look(n);
    const auto known = followed_.find(&sculpture.clay(n));
    if (!look.is_visible || known == followed_.end()) continue;
    const auto picked = known->second.feed.pick(unplaced(look.placement, ray));
    if (!picked || !picked.value()) continue;
    const Pick& pick = *picked.value();
    // Of two at the same place the active one, as in the picture.
    const bool is_first =
        !nearest || pick.distance_mm < nearest->pick.distance_mm ||
        (pick.distance_mm == nearest->pick.distance_mm && n == sculpture.active());
    if (is_first) nearest = ScenePick{n, placed(look.placement, pick)};
  }
  return nearest;
}

}  // namespace argil::viewer
