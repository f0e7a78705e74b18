#include <algorithm>
#include <numeric>

#include "model/beams/beams.hpp"
#include "model/build_steps.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// So many nodes of sets a team takes at least, unless there are no more: fewer leave threads idle.
constexpr int nodes_of_team = 128;
/// Sets that a connector does not join have one team for the sake of a row with loads of both up to so many nodes.
constexpr int most_nodes_joined = 512;
/// So many may be large: more find room beside elements the sooner, the smaller they are.
constexpr int few_teams = 8, threads_of_small = 128;
/// More rows of a team would be waited for.
constexpr std::size_t most_rows_of_team = 4096;
/// Sums of so many chunks at most are in scratch memory at a time.
constexpr int most_chunks_at_once = 128;
/// Rows without connectors and torques, which any team may gather.
constexpr int rows_of_further_team = 128;

/// Moving sets, and which of them have the same team.
class JoinedSets {
 public:
  explicit JoinedSets(const LoadModel& loads) : first_(loads.sets.moving), nodes_(loads.sets.moving) {
    std::iota(first_.begin(), first_.end(), 0);
    for (int s = 0; s < loads.sets.moving; ++s) nodes_[s] = loads.first_of_set[s + 1] - loads.first_of_set[s];
  }

  int first_of(int set) {
    while (first_[set] != set) set = first_[set] = first_[first_[set]];
    return set;
  }

  /// @param most nodes of both together, or they stay apart
  void join(int a, int b, int most) {
    a = first_of(a);
    b = first_of(b);
    if (a == b || nodes_[a] + nodes_[b] > most) return;
    nodes_[std::min(a, b)] += nodes_[std::max(a, b)];
    first_[std::max(a, b)] = std::min(a, b);
  }

  int nodes_with(int set) { return nodes_[first_of(set)]; }
  int count() const { return static_cast<int>(first_.size()); }

 private:
  std::vector<int> first_, nodes_;
};

/// Connectors, then torques; sets of one have the same team.
std::vector<SetLaw> laws_of(const LoadModel& loads, JoinedSets& joined) {
  std::vector<SetLaw> laws;
  const auto ends = to_host(loads.connectors.arrays.set);
  for (int c = 0; c < loads.connectors.arrays.count; ++c) {
    const int from = ends(c, 0), to = ends(c, 1);
    if (from >= 0 && to >= 0) joined.join(from, to, loads.first_of_set.back());
    laws.push_back({c, from, to, 0});
  }
  for (int set : to_vector(loads.torques.set)) laws.push_back({static_cast<int>(laws.size()), -1, set, 0});
  return laws;
}

/// One that is not the ground.
int a_set_of(const SetLaw& law) { return std::max(law.from, law.to); }

/// Numbers of teams by set. Sets that lie side by side in the list have one, as their rows may have loads of both.
std::vector<int> teams_of_sets(JoinedSets& joined, int& count) {
  std::vector<int> team(joined.count());
  int nodes = nodes_of_team;
  count = 0;
  for (int s = 0; s < joined.count(); ++s) {
    const int first = joined.first_of(s);
    if (first != s) {
      team[s] = team[first];
      continue;
    }
    if (nodes >= nodes_of_team) {
      ++count;
      nodes = 0;
    }
    team[s] = count - 1;
    nodes += joined.nodes_with(s);
  }
  return team;
}

void build_sums(const std::vector<int>& team_of_set, std::vector<SetTeam>& teams, LoadModel& loads) {
  const auto origin = to_host(loads.sets.origin);
  std::vector<SummedSet> summed;
  std::vector<SetChunk> chunks;
  const auto chunk_count = [&] { return static_cast<int>(chunks.size()); };
  std::vector<std::vector<int>> sets(teams.size());
  for (std::size_t s = 0; s < team_of_set.size(); ++s) sets[team_of_set[s]].push_back(static_cast<int>(s));
  for (std::size_t t = 0; t < teams.size(); ++t) {
    teams[t].first_set = static_cast<int>(summed.size());
    teams[t].first_chunk = chunk_count();
    for (int s : sets[t]) {
      const int first = chunk_count(), end = loads.first_of_set[s + 1];
      for (int k = loads.first_of_set[s]; k < end; k += SetChunk::size)
        chunks.push_back({origin(s), k, std::min(k + SetChunk::size, end), 0});
      summed.push_back({s, first, chunk_count(), 0});
    }
    teams[t].end_set = static_cast<int>(summed.size());
    teams[t].end_chunk = chunk_count();
  }
  loads.sets.summed = to_device("sets in order of teams", summed);
  loads.sets.chunks = to_device("chunks of sets", chunks);
}

void build_laws(std::vector<SetLaw> laws, const std::vector<int>& team_of_law, std::vector<SetTeam>& teams,
                SetTeams& built) {
  const auto before = [&](const SetLaw& a, const SetLaw& b) { return team_of_law[a.law] < team_of_law[b.law]; };
  std::stable_sort(laws.begin(), laws.end(), before);
  int next = 0;
  for (std::size_t t = 0; t < teams.size(); ++t) {
    teams[t].first_law = next;
    while (next < static_cast<int>(laws.size()) && team_of_law[laws[next].law] == static_cast<int>(t)) ++next;
    teams[t].end_law = next;
  }
  built.laws = to_device("connectors and torques in order of teams", laws);
}

/// Loaded rows by the team that gathers them.
struct DealtRows {
  std::vector<std::vector<LoadedRow>> of_team;
  std::vector<LoadedRow> without_law;
  std::vector<LoadedRow> others;  ///< of several teams, or with forces of beams

  /// @param first_of_beams contribution
  DealtRows(const std::vector<LoadedRow>& loaded, const std::vector<RowShare>& shares,
            const std::vector<int>& team_of_law, int teams, int first_of_beams)
      : of_team(teams) {
    for (const LoadedRow& row : loaded) {
      int team = -1;
      bool known = true;
      for (int k = row.first; k < row.last; ++k) {
        known = known && shares[k].contribution < first_of_beams;
        if (shares[k].law == RowShare::given) continue;
        const int of_law = team_of_law[shares[k].law];
        known = known && (team < 0 || team == of_law);
        team = of_law;
      }
      (!known ? others : team < 0 ? without_law : of_team[team]).push_back(row);
    }
    if (teams == 0) others.insert(others.end(), without_law.begin(), without_law.end());
  }

  /// Rows of a team beyond the first `most`.
  void leave_to_others(std::size_t most) {
    for (std::vector<LoadedRow>& rows : of_team) {
      if (rows.size() <= most) continue;
      others.insert(others.end(), rows.begin() + static_cast<long>(most), rows.end());
      rows.resize(most);
    }
  }

  /// Rows without laws go to teams that have nothing else.
  void add_further_teams() {
    for (std::size_t k = 0; !of_team.empty() && k < without_law.size(); k += rows_of_further_team)
      of_team.emplace_back(
          without_law.begin() + static_cast<long>(k),
          without_law.begin() + static_cast<long>(std::min(without_law.size(), k + rows_of_further_team)));
  }

  /// The others with few contributions, or with torques, come first. @return how many
  int sort_others(const std::vector<RowShare>& shares, int first_torque) {
    const auto is_torque = [&](const RowShare& share) { return share.law >= first_torque; };
    const auto has_few = [&](const LoadedRow& row) {
      return row.last - row.first <= ListedRowLoads::few ||
             std::any_of(shares.begin() + row.first, shares.begin() + row.last, is_torque);
    };
    return static_cast<int>(std::stable_partition(others.begin(), others.end(), has_few) - others.begin());
  }
};

/// Threads of a team, so that none needs a second turn at the chunks, the laws and so many rows.
int threads_of(const std::vector<SetTeam>& teams, std::size_t rows) {
  if (!on_device) return 1;
  constexpr int least = 64;
  const int limit = teams.size() <= few_teams ? most_threads_of_sets : threads_of_small;
  int most = static_cast<int>(rows);
  for (const SetTeam& team : teams)
    most = std::max({most, team.end_chunk - team.first_chunk, team.end_law - team.first_law});
  int threads = least;
  while (threads < most && threads < limit) threads *= 2;
  return threads;
}

}  // namespace

void build_set_teams(const std::shared_ptr<BeamModel>& beams, const ExternalForces& external, LoadModel& loads) {
  JoinedSets joined(loads);
  const std::vector<SetLaw> laws = laws_of(loads, joined);
  const std::vector<LoadedRow> loaded = to_vector(external.loaded);
  const std::vector<RowShare> shares = to_vector(external.shares);
  for (const LoadedRow& row : loaded) {
    int known = -1;
    for (int k = row.first; k < row.last; ++k) {
      if (shares[k].law == RowShare::given) continue;
      const int set = a_set_of(laws[shares[k].law]);
      if (known >= 0) joined.join(known, set, most_nodes_joined);
      known = set;
    }
  }
  int count = 0;
  const std::vector<int> team_of_set = teams_of_sets(joined, count);
  std::vector<int> team_of_law;
  for (const SetLaw& law : laws) team_of_law.push_back(team_of_set[a_set_of(law)]);
  DealtRows dealt(loaded, shares, team_of_law, count, beams ? beams->arrays.first : external.contribution_count);

  SetTeams& built = loads.set_teams;
  std::vector<SetTeam> teams(count, SetTeam{});
  build_sums(team_of_set, teams, loads);
  build_laws(laws, team_of_law, teams, built);
  std::size_t most_rows = 0;
  for (const auto& rows : dealt.of_team) most_rows = std::max(most_rows, rows.size());
  // Where others have a launch anyway they take what a team would need a second turn for.
  built.threads = threads_of(teams, dealt.others.empty() ? most_rows : 0);
  dealt.leave_to_others(dealt.others.empty() || !on_device ? most_rows_of_team : built.threads);
  dealt.add_further_teams();
  teams.resize(dealt.of_team.size(), SetTeam{});
  std::vector<LoadedRow> rows;
  for (std::size_t t = 0; t < teams.size(); ++t) {
    teams[t].first_row = static_cast<int>(rows.size());
    rows.insert(rows.end(), dealt.of_team[t].begin(), dealt.of_team[t].end());
    teams[t].end_row = static_cast<int>(rows.size());
    built.chunks_at_once =
        std::max(built.chunks_at_once, std::min(teams[t].end_chunk - teams[t].first_chunk, most_chunks_at_once));
  }
  built.count = static_cast<int>(teams.size());
  built.with_sets = count;
  built.others_with_few = dealt.sort_others(shares, loads.connectors.arrays.count);
  built.teams = to_device("teams of sets", teams);
  built.rows = to_device("rows in order of teams", rows);
  built.others = to_device("rows of other loads", dealt.others);
}

}  // namespace railwave
