#pragma once

#include <cstdint>
#include <gene_clocks/neat/settings.hpp>
#include <gene_clocks/sim/source.hpp>
#include <string>

namespace gene_clocks::sim {

enum class Task : std::uint8_t { navigation, collection };

/// What the two outputs of a controller mean.
enum class Actuation : std::uint8_t {
    translation_rotation,  ///< as the published runs had it
    wheels,                ///< the two wheel velocities (paper, section 4.1)
};

/// How a navigating robot gains energy.
enum class NavigationEnergy : std::uint8_t {
    reference,   ///< as the published runs had it
    equation_2,  ///< the paper's Equation 2
};

/// What becomes of a robot's innovation source when it reboots.
enum class RebootClock : std::uint8_t {
    kept,  ///< goes on: its counter is on stable storage
    lost,  ///< starts anew: its counter was in memory, and marks may be used twice
};

struct WorldSettings {
    std::string arena = "gecco15";  ///< a built-in arena's name or the path of a TOML file
    double arena_scale = 1.0;       ///< factor of all its lengths, frame and walls included
    std::int64_t robots = 100;
    std::int64_t items = 75;        ///< collection only
    double robot_radius_px = 2.5;   ///< half the diagonal of the robot's diamond
    double sensor_range_px = 30.0;  ///< of the eight proximity rays, from the robot's edge
    double translation_px = 2.0;    ///< largest translation in one cycle
    double acceleration_px = 2.0;   ///< largest change of translation from cycle to cycle
    double rotation_deg = 30.0;     ///< largest rotation in one cycle
    Actuation actuation = Actuation::translation_rotation;
    double item_radius_px = 6.0;           ///< of the body that rays and robots meet
    double item_reach_px = 10.0;           ///< picked up when the robot's centre is this near
    std::int64_t item_absence_cycles = 2;  ///< until a picked-up item reappears elsewhere
    /// Share of wall readings that pass for items (a slip of the reference).
    double item_slip = 0.0;
};

/// Radio: a robot is heard by those that its rays see.
struct RadioSettings {
    double range_px = 30.0;         ///< beyond the robot's edge; at most the sensor range
    double loss = 0.0;              ///< probability that one reception fails
    std::int64_t delay_cycles = 0;  ///< between sending and reception
};

struct EnergySettings {
    NavigationEnergy navigation = NavigationEnergy::reference;
    double item_gain = 10.0;  ///< per item (Equation 3)
    double decay = 0.1;       ///< per cycle, collection (Equation 3)
};

/// The robots' physical clocks: local time = offset + (1 + drift) · cycle. All zero is a perfect
/// clock, except for Source::timestamp_drift, which then takes ±10 000 cycles and ±100 ppm.
struct TimestampSettings {
    double offset_cycles = 0.0;              ///< each robot's offset is uniform in ±offset_cycles
    double drift_ppm = 0.0;                  ///< each robot's drift rate is uniform in ±drift_ppm
    double synchronised_every_cycles = 0.0;  ///< clocks are set anew this often; 0: never
    double synchronisation_error_cycles = 0.0;  ///< each time off by a uniform draw in ± this
    friend bool operator==(const TimestampSettings&, const TimestampSettings&) = default;
};

/// Robots that reboot lose what is in memory: population, tabu list and active genome.
struct RebootSettings {
    double probability = 0.0;  ///< of each robot in each cycle
    RebootClock clock = RebootClock::kept;
};

/// Robots that are switched on late. Until then one stands where it is, as an obstacle to others,
/// with its initial genome and energy; it neither sends nor receives.
struct JoinSettings {
    double late_share = 0.0;  ///< of the robots, rounded; less than all
    std::int64_t cycles = 1;  ///< each is switched on at a uniform draw from 1 to this
};

struct RunSettings {
    std::int64_t cycles = 40000;
    std::int64_t sample_period_cycles = 100;  ///< a sample of F_s, species and size this often
    bool record_creation_times = false;       ///< for chronology; free when off
};

/// Fractions of the paper's four measures (section 4.1, Figure 2).
struct MeasureSettings {
    double accumulated_share = 0.10;  ///< f_c: mean over this last share of the samples
    double budget_share = 0.90;       ///< f_b: the sample at this share of the run
    double target_share = 0.90;       ///< t_f, f_a: target as a share of the best F_s
    double best_fitness = 0.0;        ///< the best F_s over all compared runs; 0: this run's own
};

/// Everything that a run depends on besides its seed.
struct Settings {
    Task task = Task::navigation;
    Source source = Source::gene_clock;
    neat::OdneatSettings odneat;
    WorldSettings world;
    RadioSettings radio;
    EnergySettings energy;
    TimestampSettings timestamp;
    RebootSettings reboot;
    JoinSettings join;
    RunSettings run;
    MeasureSettings measures;
};

}  // namespace gene_clocks::sim
