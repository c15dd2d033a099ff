/** GeoGebra 4.0 by its own interface: reads commands, parts set off by tabs, and answers each with one line. */

import geogebra.CommandLineArguments;
import geogebra.kernel.GeoElement;
import geogebra.kernel.GeoNumeric;
import geogebra.kernel.GeoPoint;
import geogebra.kernel.GeoVector;
import geogebra.main.Application;
import geogebra.plugin.GgbAPI;
import java.io.BufferedReader;
import java.io.File;
import java.io.InputStreamReader;
import java.io.PrintStream;
import javax.swing.JFrame;

public class GeoGebraDriver {
    static Application app;

    public static void main(String[] arguments) throws Exception {
        PrintStream out = new PrintStream(System.out, true, "UTF-8");
        System.setOut(System.err);
        JFrame frame = new JFrame();
        String[] options = {"--showSplash=false", "--language=en"};
        app = new Application(new CommandLineArguments(options), frame, true);
        frame.getContentPane().add(app.buildApplicationPanel());
        frame.setSize(1400, 950);
        frame.setVisible(true);
        BufferedReader in = new BufferedReader(new InputStreamReader(System.in, "UTF-8"));
        for (String line = in.readLine(); line != null; line = in.readLine()) {
            try {
                out.println(answer(line.split("\t")));
            } catch (Throwable problem) {
                out.println("error " + problem);
            }
        }
        System.exit(0);
    }

    static Object answer(String[] part) throws Exception {
        GgbAPI api = app.getGgbApi();
        switch (part[0]) {
            case "open":
                return app.loadFile(new File(part[1]), false);
            case "set":
                api.setValue(part[1], Double.parseDouble(part[2]));
                return true;
            case "drag":
                api.setCoords(part[1], Double.parseDouble(part[2]), Double.parseDouble(part[3]));
                return true;
            case "step":
                app.getKernel().setConstructionStep(app.getKernel().getLastConstructionStep());
                app.getKernel().setConstructionStep(app.getKernel().lookupLabel(part[1]).getConstructionIndex());
                return true;
            case "picture":
                return api.writePNGtoFile(part[1], 1.0, false, 72);
            default:
                StringBuilder told = new StringBuilder();
                for (Object one : app.getKernel().getConstruction().getGeoSetConstructionOrder()) {
                    GeoElement object = (GeoElement) one;
                    boolean there = object.getConstructionIndex() <= app.getKernel().getConstructionStep();
                    String seen = there && object.isEuclidianVisible() ? "seen" : "hidden";
                    told.append(object.getLabel() + "\t" + seen + " " + where(object) + "\t");
                }
                return told;
        }
    }

    static String where(GeoElement object) {
        if (!object.isDefined()) {
            return "nan nan";
        }
        if (object instanceof GeoPoint) {
            return ((GeoPoint) object).getInhomX() + " " + ((GeoPoint) object).getInhomY();
        }
        if (object instanceof GeoVector) {
            return ((GeoVector) object).x + " " + ((GeoVector) object).y;
        }
        return object instanceof GeoNumeric ? ((GeoNumeric) object).getDouble() + " 0" : "0 0";
    }
}
