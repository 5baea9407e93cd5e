#pragma once

namespace CLI {
class App;
}

namespace fastball::launch {

/// Adds a subcommand to the `fastball` command. When the command line names it, it runs while the
/// line is being parsed and leaves its exit status (messaging/process.h) in `exit_status`; what it
/// throws means: std::invalid_argument wrong usage or a bad input file, any other std::exception a
/// failed experiment.
void addRunCommand(CLI::App& app, int& exit_status);
void addBenchCommand(CLI::App& app, int& exit_status);
void addAtlasCommand(CLI::App& app, int& exit_status);
void addLogCommand(CLI::App& app, int& exit_status);
void addReplayCommand(CLI::App& app, int& exit_status);
void addFiguresCommand(CLI::App& app, int& exit_status);
void addKeyCommand(CLI::App& app, int& exit_status);
void addReportCommand(CLI::App& app, int& exit_status);
void addCalibrateCommand(CLI::App& app, int& exit_status);
void addTrackCommand(CLI::App& app, int& exit_status);
void addDoctorCommand(CLI::App& app, int& exit_status);
void addCampaignCommand(CLI::App& app, int& exit_status);
void addManualCommand(CLI::App& app, int& exit_status);
void addDocsCommand(CLI::App& app, int& exit_status);
void addSpyCommand(CLI::App& app, int& exit_status);
void addViewCommand(CLI::App& app, int& exit_status);
/// up, down, ps, hold
void addSystemCommands(CLI::App& app, int& exit_status);

}  // namespace fastball::launch
