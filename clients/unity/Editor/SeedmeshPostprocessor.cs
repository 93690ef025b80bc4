using System.IO;
using UnityEditor;
using UnityEngine;

namespace Seedmesh.Editor
{
    /// <summary>Makes a prefab with levels and colliders of each GLB file that belongs to a request file.</summary>
    public class SeedmeshPostprocessor : AssetPostprocessor
    {
        static void OnPostprocessAllAssets(string[] imported, string[] deleted, string[] moved, string[] moved_from)
        {
            foreach (var path in imported)
            {
                if (Path.GetExtension(path) != ".glb" || !File.Exists(Path.ChangeExtension(path, ".seedmesh"))) continue;
                var model = AssetDatabase.LoadAssetAtPath<GameObject>(path);
                if (model == null) continue;
                var copy = (GameObject)PrefabUtility.InstantiatePrefab(model);
                PrefabUtility.UnpackPrefabInstance(copy, PrefabUnpackMode.Completely, InteractionMode.AutomatedAction);
                SeedmeshLevels.SetUp(copy, SeedmeshFile.HeightsOf(path));
                PrefabUtility.SaveAsPrefabAsset(copy, Path.ChangeExtension(path, ".prefab"));
                Object.DestroyImmediate(copy);
            }
        }
    }
}
